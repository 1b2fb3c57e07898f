#include "engine/register/warp.h"

#include <algorithm>

#include "engine/data/parallel.h"

namespace spherematch {
namespace {

/// Calls `carry` on copies of runs of rows, independently of each other.
template <typename Carry>
Points in_runs(const Points& points, int threads, const Carry& carry) {
  constexpr Eigen::Index kRun = 4096;
  Points result(points.rows(), 3);
  run_parallel(static_cast<std::size_t>((points.rows() + kRun - 1) / kRun), threads, [&](std::size_t i) {
    const Eigen::Index first = static_cast<Eigen::Index>(i) * kRun, count = std::min(kRun, points.rows() - first);
    Points run = points.middleRows(first, count);
    carry(run);
    result.middleRows(first, count) = run;
  });
  return result;
}

}  // namespace

Points Warp::forward(const Points& points, int threads) const {
  return in_runs(points, threads, [this](Points& run) {
    run *= rotation_.transpose();
    for (const Step& step : steps_) advect(run, *step.field, step.length);
  });
}

Points Warp::backward(const Points& points, int threads) const {
  return in_runs(points, threads, [this](Points& run) {
    for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) advect(run, *step->field, -step->length);
    run *= rotation_;
  });
}

}  // namespace spherematch
