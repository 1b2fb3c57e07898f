// Loops over nodes or triangles, on several threads.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/data/parallel.h"

namespace spherematch {

inline constexpr Eigen::Index longest_run = 1024;

/// Calls task(first, last) for runs of 0 .. count - 1 that do not depend on the number of threads.
template <typename Task>
void for_runs(Eigen::Index count, int threads, const Task& task) {
  run_parallel(static_cast<std::size_t>((count + longest_run - 1) / longest_run), threads, [&](std::size_t run) {
    const Eigen::Index first = static_cast<Eigen::Index>(run) * longest_run;
    task(first, std::min(count, first + longest_run));
  });
}

/// The sum of the matrices task(first, last) of such runs, added in their order.
template <typename Task>
Eigen::MatrixXd sum_over_runs(Eigen::Index count, int threads, const Task& task) {
  std::vector<Eigen::MatrixXd> parts(static_cast<std::size_t>((count + longest_run - 1) / longest_run));
  for_runs(count, threads,
           [&](Eigen::Index first, Eigen::Index last) { parts[static_cast<std::size_t>(first / longest_run)] = task(first, last); });
  for (std::size_t i = 1; i < parts.size(); ++i) parts.front() += parts[i];
  return parts.empty() ? Eigen::MatrixXd() : std::move(parts.front());
}

}  // namespace spherematch
