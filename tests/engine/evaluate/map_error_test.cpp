#include "engine/evaluate/map_error.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "engine/mesh/repair.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

/// A regular tetrahedron, and an unreferenced fifth vertex.
Surface target() {
  TriMesh mesh = test::tetrahedron();
  mesh.vertices << 1, 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1;
  test::resize_vertices(mesh, 5);
  return repair(test::polygons(mesh), RepairMode::fill);
}

/// Vertex i goes to the point with weight w at corner a and 1 - w at corner b of a face.
Correspondence map_to(const std::vector<std::array<std::int32_t, 3>>& corners, float weight) {
  Correspondence map;
  const auto count = static_cast<Eigen::Index>(corners.size());
  map.corners.resize(count, 3);
  map.bary.resize(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& c = corners[static_cast<std::size_t>(i)];
    map.corners.row(i) << c[0], c[1], c[2];
    map.bary.row(i) << weight, 1 - weight, 0;
    map.vertex.push_back(c[0]);
  }
  return map;
}

TEST(GeodesicError, IsTheDistanceOverTheRootOfTheArea) {
  const Surface surface = target();
  const double edge = (surface.mesh.vertices.row(0) - surface.mesh.vertices.row(1)).norm();
  const double unit = std::sqrt(std::sqrt(3.0) * edge * edge);  // of a regular tetrahedron
  const std::vector<Landmark> truth{{0, 0}, {1, 1}};
  const MapError exact = geodesic_error(map_to({{0, 1, 2}, {1, 2, 0}}, 1), surface, truth);
  EXPECT_LT(exact.max, 1e-15);
  EXPECT_EQ(exact.scored, 2);
  // A quarter of an edge away within a face; and all the way to another vertex.
  const MapError near = geodesic_error(map_to({{0, 1, 2}, {1, 2, 0}}, 0.75F), surface, truth);
  EXPECT_NEAR(near.mean, edge / 4 / unit, 1e-12);
  EXPECT_NEAR(near.max, near.mean, 1e-12);
  const MapError far = geodesic_error(map_to({{0, 1, 2}, {2, 0, 3}}, 1), surface, truth);
  EXPECT_NEAR(far.mean, edge / 2 / unit, 1e-12);
  EXPECT_NEAR(far.max, edge / unit, 1e-12);
  EXPECT_NEAR(far.median, edge / 2 / unit, 1e-12);
  EXPECT_NEAR(far.p95, 0.95 * edge / unit, 1e-12);
}

TEST(GeodesicError, GoesFromTheNearestCornerInAStraightLine) {
  const Surface surface = target();
  const double edge = (surface.mesh.vertices.row(0) - surface.mesh.vertices.row(1)).norm();
  const double unit = std::sqrt(std::sqrt(3.0) * edge * edge);
  // From a point of the edge 1-2, a quarter from 1, to vertex 3: by way of 1.
  const std::vector<Landmark> truth{{0, 3}};
  EXPECT_NEAR(geodesic_error(map_to({{1, 2, 0}}, 0.75F), surface, truth).mean, 1.25 * edge / unit, 1e-12);
}

TEST(GeodesicError, LeavesOutDroppedVertices) {
  Correspondence map = map_to({{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}, 1);
  map.vertex[1] = -1;
  map.corners.row(1).setConstant(-1);
  map.bary.row(1).setZero();
  const MapError error = geodesic_error(map, target(), std::vector<Landmark>{{0, 4}, {1, 1}, {2, 2}});
  EXPECT_EQ(error.unscored, 2);
  EXPECT_EQ(error.scored, 1);
  EXPECT_EQ(error.max, 0);
  EXPECT_EQ(geodesic_error(map, target(), std::vector<Landmark>{{1, 1}}).mean, 0) << "nothing scored";
}

TEST(GeodesicError, RefusesWhatIsNoVertex) {
  const Correspondence map = map_to({{0, 1, 2}}, 1);
  for (const Landmark landmark : {Landmark{-1, 0}, Landmark{1, 0}, Landmark{0, -1}, Landmark{0, 5}}) {
    test::expect_refusal(ErrorCode::invalid_parameter, [&] { (void)geodesic_error(map, target(), std::vector<Landmark>{landmark}); });
  }
  const Correspondence beyond = map_to({{0, 1, 9}}, 1);
  test::expect_refusal(ErrorCode::invalid_parameter, [&] { (void)geodesic_error(beyond, target(), std::vector<Landmark>{{0, 0}}); });
}

}  // namespace
}  // namespace spherematch
