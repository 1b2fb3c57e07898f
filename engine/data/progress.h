// How a long computation says where it is, and learns that it should stop.
#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

#include "engine/data/error.h"

namespace spherematch {

/// Passed by const reference through every stage. `report` may be called from several threads at once and must not throw.
struct Progress {
  std::function<void(std::string_view stage, double fraction)> report;  ///< fraction of the whole job in [0, 1]; may be empty
  std::stop_token stop;

  /// Every loop that can take longer than 0.2 s calls this once per iteration.
  /// @throws EngineError(cancelled)
  void check() const {
    if (stop.stop_requested()) throw EngineError(ErrorCode::cancelled, "cancelled");
  }
};

}  // namespace spherematch
