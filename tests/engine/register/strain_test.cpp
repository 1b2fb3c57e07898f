#include "engine/register/strain.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/engine/sphere/spheres.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

using Eigen::Vector3d;

MovingTriangle some_triangle(std::uint64_t seed) {
  test::Random random(seed);
  MovingTriangle result;
  for (std::size_t k = 0; k < 3; ++k) {
    result.corners[k] = random.unit_vector();
    result.velocities[k].col(0) = random.unit_vector();
    result.velocities[k].col(1) = random.unit_vector();
  }
  return result;
}

MovingTriangle mapped(MovingTriangle triangle, const Eigen::Matrix3d& matrix) {
  for (Vector3d& corner : triangle.corners) corner = matrix * corner + Vector3d(1, -2, 3);
  return triangle;
}

/// The triangle after its node k has moved.
MovingTriangle moved(MovingTriangle triangle, std::size_t k, int direction, double by) {
  triangle.corners[k] += by * triangle.velocities[k].col(direction);
  return triangle;
}

Strain strain_between(const MovingTriangle& source, const MovingTriangle& target) { return strain(FlatTriangle(source.corners), target); }

TEST(Strain, OfARigidMotionIsNone) {
  const MovingTriangle triangle = some_triangle(1);
  const Strain s = strain_between(triangle, mapped(triangle, test::some_rotation()));
  EXPECT_LT(s.values.norm(), 1e-12);
}

TEST(Strain, IsTheLogarithmOfStretches) {
  MovingTriangle flat = some_triangle(2);
  flat.corners = {Vector3d(0, 0, 0), Vector3d(1, 0.3, 0), Vector3d(0.2, 1.5, 0)};
  const Vector3d stretches(2, 0.5, 1);
  const Strain stretched = strain_between(flat, mapped(flat, test::some_rotation() * stretches.asDiagonal()));
  EXPECT_NEAR(stretched.values[0], 0, 1e-12);
  EXPECT_NEAR(stretched.values[1], std::log(4.0), 1e-12);
  const Strain grown = strain_between(flat, mapped(flat, 3 * test::some_rotation()));
  EXPECT_NEAR(grown.values[0], 2 * std::log(3.0), 1e-12);
  EXPECT_NEAR(grown.values[1], 0, 1e-12);
  EXPECT_NEAR(grown.area, 5 * strain_between(flat, flat).area, 1e-12);
}

TEST(Strain, IsTheSameBothWays) {
  const MovingTriangle a = some_triangle(3), b = some_triangle(4);
  const Strain there = strain_between(a, b), back = strain_between(b, a);
  EXPECT_NEAR(there.values[0], -back.values[0], 1e-12);
  EXPECT_NEAR(there.values[1], back.values[1], 1e-12);
  EXPECT_EQ(there.area, back.area);
}

TEST(Strain, DerivativesAreThoseOfTheValues) {
  const MovingTriangle source = some_triangle(5), target = some_triangle(6);
  const Strain s = strain_between(source, target);
  const double h = 1e-5;
  for (std::size_t k = 0; k < 3; ++k)
    for (int direction = 0; direction < 2; ++direction) {
      const Strain plus = strain_between(source, moved(target, k, direction, h)),
                   minus = strain_between(source, moved(target, k, direction, -h));
      const Vector3d expected = (plus.values - minus.values) / (2 * h), found = s.derivatives.col(2 * static_cast<int>(k) + direction);
      EXPECT_NEAR(found[0], expected[0], 1e-6 * (1 + std::abs(expected[0])));
      EXPECT_NEAR(found[1], expected[1], 1e-6 * (1 + std::abs(expected[1])));
    }
}

TEST(Strain, ShearCountsAsLossOfShape) {
  // From no strain on, the loss of shape grows with the length of its and the shear's derivatives.
  const MovingTriangle triangle = some_triangle(7);
  const Strain s = strain_between(triangle, triangle);
  const double h = 1e-5;
  for (std::size_t k = 0; k < 3; ++k) {
    const Strain after = strain_between(triangle, moved(triangle, k, 0, h));
    const double length = s.derivatives.col(2 * static_cast<int>(k)).tail<2>().norm();
    EXPECT_NEAR(after.values[1] / h, length, 1e-3 * length);
  }
}

TEST(Strain, OfATriangleWithoutAreaIsNone) {
  MovingTriangle needle = some_triangle(8);
  needle.corners[2] = needle.corners[0];
  EXPECT_EQ(strain_between(needle, some_triangle(9)).area, 0);
  EXPECT_EQ(strain_between(some_triangle(9), needle).area, 0);
}

}  // namespace
}  // namespace spherematch
