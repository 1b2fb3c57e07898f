#include "engine/mesh/polygon_triangulation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>

namespace spherematch {
namespace {

const auto anything = [](std::int32_t, std::int32_t) { return true; };

/// Twice the area vector summed over the triangles, and the sum of areas.
std::pair<Eigen::Vector3d, double> areas(const std::vector<Eigen::Vector3d>& polygon, const PolygonTriangles& triangles) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0;
  for (const auto& [i, j, k] : triangles) {
    const Eigen::Vector3d& a = polygon[static_cast<std::size_t>(i)];
    const Eigen::Vector3d normal = (polygon[static_cast<std::size_t>(j)] - a).cross(polygon[static_cast<std::size_t>(k)] - a);
    sum += normal;
    area += normal.norm() / 2;
  }
  return {sum, area};
}

TEST(PolygonTriangulation, CoversAConcavePolygonWithoutFolds) {
  // A comb with three teeth; no fan from one corner covers it.
  const std::vector<Eigen::Vector3d> comb{{0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {4, 3, 0}, {4, 1, 0}, {3, 1, 0},
                                          {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  const auto triangles = triangulate_polygon(comb, anything);
  ASSERT_TRUE(triangles);
  EXPECT_EQ(triangles->size(), comb.size() - 2);
  const auto [sum, area] = areas(comb, *triangles);
  EXPECT_NEAR(sum.z(), 22, 1e-12);  // counter-clockwise like the polygon
  EXPECT_NEAR(area, 11, 1e-12);
}

TEST(PolygonTriangulation, TakesTheShorterDiagonalOfAQuad) {
  const std::vector<Eigen::Vector3d> kite{{0, 0, 0}, {2, -0.5, 0}, {4, 0, 0}, {2, 0.5, 0}};
  const auto triangles = triangulate_polygon(kite, anything);
  ASSERT_TRUE(triangles);
  for (const auto& triangle : *triangles) {
    const std::set<std::int32_t> corners(triangle.begin(), triangle.end());
    EXPECT_TRUE(corners.contains(1) && corners.contains(3));
  }
}

TEST(PolygonTriangulation, AvoidsTrianglesWithoutArea) {
  // A square with a corner in the middle of each side.
  const std::vector<Eigen::Vector3d> square{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  const auto triangles = triangulate_polygon(square, anything);
  ASSERT_TRUE(triangles);
  for (const auto& triangle : *triangles) EXPECT_GT(areas(square, {triangle}).second, 0.4);
}

TEST(PolygonTriangulation, KeepsToAllowedChords) {
  const std::vector<Eigen::Vector3d> kite{{0, 0, 0}, {2, -0.5, 0}, {4, 0, 0}, {2, 0.5, 0}};
  const auto triangles = triangulate_polygon(kite, [](std::int32_t i, std::int32_t j) { return !(i == 1 && j == 3); });
  ASSERT_TRUE(triangles);
  for (const auto& triangle : *triangles) {
    const std::set<std::int32_t> corners(triangle.begin(), triangle.end());
    EXPECT_TRUE(corners.contains(0) && corners.contains(2));
  }
  EXPECT_FALSE(triangulate_polygon(kite, [](std::int32_t, std::int32_t) { return false; }));
}

TEST(PolygonTriangulation, ATriangleNeedsNoChord) {
  const auto triangles = triangulate_polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, [](std::int32_t, std::int32_t) { return false; });
  ASSERT_TRUE(triangles);
  EXPECT_EQ(*triangles, (PolygonTriangles{{0, 1, 2}}));
}

TEST(PolygonTriangulation, HasLimits) {
  EXPECT_FALSE(triangulate_polygon({{0, 0, 0}, {1, 0, 0}}, anything));
  std::vector<Eigen::Vector3d> circle;
  for (int i = 0; i <= most_triangulated_corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / static_cast<double>(most_triangulated_corners + 1);
    circle.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  EXPECT_FALSE(triangulate_polygon(circle, anything));
  circle.pop_back();
  const auto triangles = triangulate_polygon(circle, anything);
  ASSERT_TRUE(triangles);
  EXPECT_EQ(triangles->size(), circle.size() - 2);
}

}  // namespace
}  // namespace spherematch
