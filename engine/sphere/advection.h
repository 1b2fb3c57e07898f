// Tangent vector fields sampled anywhere on the sphere, and the advection of points along them (paper section 4.1).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/data/tri_mesh.h"
#include "engine/sphere/grid_place.h"
#include "engine/sphere/harmonics.h"

namespace spherematch {

/// A tangent field given at the grid's cell centres, interpolated bilinearly as Cartesian vectors, which have no singularity at
/// the poles. Immutable.
class TangentField {
 public:
  explicit TangentField(const TangentGrid& grid);

  /// The vector at a unit vector `p`, tangent there.
  [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& p) const;

  /// The same before the part along p, which rounding and interpolation leave, is taken off.
  [[nodiscard]] Eigen::Vector3d interpolate(const GridPlace& place) const;

 private:
  int resolution_;
  std::vector<Eigen::Vector4d> samples_;  ///< (N + 2) x (N + 2), a border of one cell on each side
};

/// exp_p(v): the end of the geodesic that leaves p with tangent v, |v| its length.
[[nodiscard]] Eigen::Vector3d geodesic_step(const Eigen::Vector3d& p, const Eigen::Vector3d& v);

/// One step of size `step` for each point: the mean of the field at the start and, transported back, at the end of the
/// geodesic that the field at the start points along. Local error of third order.
void advect(Points& points, const TangentField& field, double step);

}  // namespace spherematch
