#include "engine/register/strain.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace spherematch {
namespace {

constexpr double kLeastArea = 1e-12;    // of surfaces of area one
constexpr double kLeastStretch = 1e-3;  // keeps logarithms of needles finite

/// How the edges change when corner k moves with the velocity.
Eigen::Matrix2d change(const FlatTriangle& triangle, int k, const Eigen::Vector3d& velocity) {
  const Eigen::Vector2d v = triangle.axes * velocity;
  Eigen::Matrix2d result = Eigen::Matrix2d::Zero();
  if (k == 0)
    result.colwise() = -v;
  else
    result.col(k - 1) = v;
  return result;
}

/// J = U diag(s, t) V', s >= t, for a J of positive determinant; U and V are rotations.
struct Principal {
  explicit Principal(const Eigen::Matrix2d& J) {
    const double e = (J(0, 0) + J(1, 1)) / 2, f = (J(0, 0) - J(1, 1)) / 2, g = (J(1, 0) + J(0, 1)) / 2, h = (J(1, 0) - J(0, 1)) / 2;
    const double q = std::hypot(e, h), r = std::hypot(f, g), sum = std::atan2(h, e), difference = std::atan2(g, f);
    s = std::max(q + r, kLeastStretch);
    t = std::max(q - r, kLeastStretch);
    U = Eigen::Rotation2Dd((sum + difference) / 2).toRotationMatrix();
    V = Eigen::Rotation2Dd((difference - sum) / 2).toRotationMatrix();
  }

  double s, t;
  Eigen::Matrix2d U, V;
};

}  // namespace

FlatTriangle::FlatTriangle(const TriangleCorners& corners) {
  const Eigen::Vector3d ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  const Eigen::Vector3d normal = ab.cross(ac);
  const double size = normal.norm();
  if (size / 2 < kLeastArea) return;
  area = size / 2;
  axes.row(0) = ab.normalized();
  axes.row(1) = (normal / size).cross(ab.normalized());
  edges << axes * ab, axes * ac;
}

Strain strain(const FlatTriangle& source, const MovingTriangle& target) {
  Strain result;
  const FlatTriangle to(target.corners);
  if (!(source.area > 0 && to.area > 0)) return result;
  result.area = (source.area + to.area) / 2;
  const Eigen::Matrix2d inverse = source.edges.inverse();
  const Principal principal(to.edges * inverse);
  const double a = std::log(principal.s), b = std::log(principal.t);
  result.values << a + b, a - b, 0;
  for (int k = 0; k < 3; ++k) {
    for (int direction = 0; direction < 2; ++direction) {
      const Eigen::Matrix2d moved = change(to, k, target.velocities[static_cast<std::size_t>(k)].col(direction));
      const Eigen::Matrix2d K = principal.U.transpose() * moved * inverse * principal.V;
      const double da = K(0, 0) / principal.s, db = K(1, 1) / principal.t;
      result.derivatives.col(2 * k + direction) << da + db, da - db, 2 * (K(0, 1) + K(1, 0)) / (principal.s + principal.t);
    }
  }
  return result;
}

}  // namespace spherematch
