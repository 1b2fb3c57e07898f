// Loops over nodes or triangles, on several threads.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>

#include "engine/data/parallel.h"

namespace spherematch {

/// Calls task(first, last) for runs of 0 .. count - 1 that do not depend on the number of threads.
template <typename Task>
void for_runs(Eigen::Index count, int threads, const Task& task) {
  constexpr Eigen::Index kRun = 1024;
  run_parallel(static_cast<std::size_t>((count + kRun - 1) / kRun), threads, [&](std::size_t run) {
    const Eigen::Index first = static_cast<Eigen::Index>(run) * kRun;
    task(first, std::min(count, first + kRun));
  });
}

}  // namespace spherematch
