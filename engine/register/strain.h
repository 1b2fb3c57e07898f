// How a map strains one triangle: logarithmic strain (Hencky 1928).
#pragma once

#include <Eigen/Core>
#include <array>

namespace spherematch {

/// A triangle on a surface, and how its corners move when their nodes on the sphere do: a column per tangent direction.
struct MovingTriangle {
  std::array<Eigen::Vector3d, 3> corners;
  std::array<Eigen::Matrix<double, 3, 2>, 3> velocities;
};

/// The logarithmic strain of the affine map between two triangles, with singular values s and t: log s + log t, the change of area; log s -
/// log t, the loss of shape; and the shear between the principal directions, zero as such. Least squares of these, weighted alike for the
/// last two, are an elastic energy that treats stretching and compressing alike.
struct Strain {
  double area = 0;         ///< mean of both triangles; zero for a triangle without area, whose strain is undefined
  Eigen::Vector3d values;  ///< (change of area, loss of shape, 0)
  Eigen::Matrix<double, 3, 6>
      derivatives;  ///< by the corners' moves, two columns each, where the source moves by -1/2 and the target by 1/2
};

[[nodiscard]] Strain strain(const MovingTriangle& source, const MovingTriangle& target);

}  // namespace spherematch
