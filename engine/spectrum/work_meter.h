// How far a computation of many pieces is. Internal to engine/spectrum.
#pragma once

#include <algorithm>
#include <functional>
#include <mutex>

#include "engine/data/progress.h"

namespace spherematch {

/// Counts work done, in any unit, against what was planned. Thread-safe.
class WorkMeter {
 public:
  /// `report` may be empty; it is told fractions in [0, 1] that never fall, one call at a time. Both are kept by reference.
  WorkMeter(const Progress& progress, const std::function<void(double)>& report) : progress_(progress), report_(report) {}

  void plan(double work) { planned_ += work; }

  /// @throws EngineError(cancelled)
  void add(double work) {
    progress_.check();
    const std::scoped_lock lock(mutex_);
    done_ += work;
    if (report_) report_(std::min(1.0, done_ / std::max(planned_, done_)));
  }

  [[nodiscard]] const Progress& progress() const { return progress_; }

 private:
  const Progress& progress_;
  const std::function<void(double)>& report_;
  std::mutex mutex_;
  double planned_ = 0, done_ = 0;
};

}  // namespace spherematch
