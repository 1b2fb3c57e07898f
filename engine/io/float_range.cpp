#include "engine/io/float_range.h"

#include <algorithm>
#include <limits>

namespace spherematch {

Box box_of(const Points& points) {
  Box box;
  bool empty = true;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::RowVector3d point = points.row(i);
    if (point.hasNaN()) continue;
    box.low = empty ? point : box.low.cwiseMin(point);
    box.high = empty ? point : box.high.cwiseMax(point);
    empty = false;
  }
  return box;
}

bool fits_float(const Box& box) {
  constexpr double most_blur = 1e-5;
  const double farthest = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
  if (farthest > std::numeric_limits<float>::max()) return false;
  // Below the smallest normal float the steps no longer shrink with the numbers.
  const double step = std::max<double>(farthest * std::numeric_limits<float>::epsilon(), std::numeric_limits<float>::min());
  return step <= most_blur * box.radius();
}

}  // namespace spherematch
