// How a map strains one triangle: logarithmic strain (Hencky 1928).
#pragma once

#include <Eigen/Core>
#include <array>

namespace spherematch {

using TriangleCorners = std::array<Eigen::Vector3d, 3>;

/// A triangle in its own plane.
struct FlatTriangle {
  explicit FlatTriangle(const TriangleCorners& corners);

  double area = 0;                   ///< zero for one without extent, whose other members are undefined
  Eigen::Matrix<double, 2, 3> axes;  ///< of the plane, orthonormal
  Eigen::Matrix2d edges;             ///< from the first corner to the others
};

/// A triangle on a surface, and how its corners move when their nodes on the sphere do: a column per tangent direction.
struct MovingTriangle {
  TriangleCorners corners;
  std::array<Eigen::Matrix<double, 3, 2>, 3> velocities;
};

/// The logarithmic strain of the affine map between two triangles, with singular values s and t: log s + log t, the change of area; log s -
/// log t, the loss of shape; and the shear between the principal directions, zero as such. Least squares of these, weighted alike for the
/// last two, are an elastic energy that treats stretching and compressing alike.
struct Strain {
  double area = 0;                          ///< mean of both triangles; zero where either has none and strain is undefined
  Eigen::Vector3d values;                   ///< (change of area, loss of shape, 0)
  Eigen::Matrix<double, 3, 6> derivatives;  ///< by the moves of the target's corners, two columns each
};

[[nodiscard]] Strain strain(const FlatTriangle& source, const MovingTriangle& target);

}  // namespace spherematch
