// Seconds of repeated runs.
#pragma once

#include <functional>
#include <vector>

#include "engine/data/preprocessed_shape.h"

namespace spherematch::bench {

/// The middle one; of an even number the mean of the middle two. Nought of nothing.
[[nodiscard]] double median(std::vector<double> values);

/// What repeated runs of one thing took.
struct Timing {
  StageSeconds seconds;    ///< wall clock: the median of each stage by itself, in the order of the first run
  double cpu_seconds = 0;  ///< median, all threads together
  int runs = 0;
};

/// Runs `run`, which returns its stages, `runs` times, at least once. No further run begins once they took `budget_seconds` together.
[[nodiscard]] Timing measure(int runs, double budget_seconds, const std::function<StageSeconds()>& run);

/// Seconds of the stage "total"; nought where there is none.
[[nodiscard]] double total_of(const StageSeconds& seconds);

}  // namespace spherematch::bench
