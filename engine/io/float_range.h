// Whether points can be written as float. Internal to engine/io.
#pragma once

#include <Eigen/Core>

#include "engine/data/tri_mesh.h"

namespace spherematch {

/// The box of the points, without those that are NaN. Corners are zero where no point is left.
struct Box {
  Eigen::RowVector3d low = Eigen::RowVector3d::Zero();
  Eigen::RowVector3d high = Eigen::RowVector3d::Zero();

  [[nodiscard]] Eigen::RowVector3d center() const { return low / 2 + high / 2; }
  /// Half of the longest side. The order of the operations keeps it finite.
  [[nodiscard]] double radius() const { return (high / 2 - low / 2).maxCoeff(); }
};
[[nodiscard]] Box box_of(const Points& points);

/// False where float would move points by more than 1e-5 of the box's radius, or cannot hold them at all.
[[nodiscard]] bool fits_float(const Box& box);

}  // namespace spherematch
