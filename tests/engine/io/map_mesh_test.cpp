#include "engine/io/map_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/engine/io/some_maps.h"

namespace spherematch::test {
namespace {

TEST(MapMesh, TheIdentityTakesEachVertexToItself) {
  const PolygonMesh sphere = polygons(icosphere(3));
  const Surface surface = repair(sphere, RepairMode::none);
  const MapMesh painted = paint_mesh(sphere, identity_map(surface), surface);
  EXPECT_EQ(painted.images, sphere.vertices);
  const Eigen::RowVector3d low = sphere.vertices.colwise().minCoeff();
  const Eigen::RowVector3d extent = sphere.vertices.colwise().maxCoeff() - low;
  for (Eigen::Index v = 0; v < sphere.vertices.rows(); ++v) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(painted.colors(v, k), 255 * (sphere.vertices(v, k) - low(k)) / extent(k), 0.5 + 1e-9);
  }
  // All of the range is used.
  EXPECT_EQ(painted.colors.cast<int>().minCoeff(), 0);
  EXPECT_EQ(painted.colors.cast<int>().maxCoeff(), 255);
}

TEST(MapMesh, AnImageLiesInsideItsTriangle) {
  const Surface surface = repair(polygons(icosphere(1)), RepairMode::none);
  Correspondence map;
  map.vertex = {0};
  map.corners.resize(1, 3);
  map.corners = surface.uploaded_corners.row(7);
  map.bary.resize(1, 3);
  map.bary << 0.5F, 0.25F, 0.25F;
  const Points image = image_points(map, surface);
  const auto corner = [&](int k) { return surface.mesh.vertices.row(map.corners(0, k)); };
  EXPECT_LT((image.row(0) - (0.5 * corner(0) + 0.25 * corner(1) + 0.25 * corner(2))).norm(), 1e-15);
}

TEST(MapMesh, ADroppedVertexIsGrayAndDoesNotBendTheColors) {
  const PolygonMesh upload = sphere_and_stray();
  const Surface surface = repair(upload, RepairMode::fill);
  ASSERT_EQ(surface.report.dropped_vertices, 4);
  const MapMesh painted = paint_mesh(upload, identity_map(surface), surface);
  const Surface alone = repair(polygons(icosphere(2)), RepairMode::none);
  const MapMesh expected = paint_mesh(polygons(icosphere(2)), identity_map(alone), alone);
  EXPECT_EQ(painted.images.topRows(162), expected.images);
  EXPECT_EQ(painted.colors.topRows(162), expected.colors);
  for (Eigen::Index v = 162; v < 166; ++v) {
    EXPECT_EQ(painted.colors.row(v).cast<int>(), Eigen::RowVector3i::Constant(128));
    EXPECT_TRUE(painted.images.row(v).array().isNaN().all());
  }
}

TEST(MapMesh, AnAxisWithoutExtentIsInTheMiddle) {
  Surface flat;
  flat.mesh.vertices.resize(3, 3);
  flat.mesh.vertices << 0, 0, 7, 2, 0, 7, 0, 4, 7;
  flat.surface_vertex = {0, 1, 2};
  Points points(2, 3);
  points << 1, 1, 7, 5, -1, 9;  // the second outside the box
  Points expected(2, 3);
  expected << 0.5, 0.25, 0.5, 1, 0, 0.5;
  EXPECT_EQ(normalized_coordinates(points, flat), expected);
}

TEST(MapMesh, AMapOfAnotherMeshIsRefused) {
  const PolygonMesh sphere = polygons(icosphere(1));
  const Surface surface = repair(sphere, RepairMode::none);
  EXPECT_THROW((void)paint_mesh(polygons(icosphere(2)), identity_map(surface), surface), std::invalid_argument);
  Correspondence beyond = identity_map(surface);
  beyond.corners(3, 1) = 42;
  EXPECT_THROW((void)paint_mesh(sphere, beyond, surface), std::invalid_argument);
  const Surface with_stray = repair(sphere_and_stray(), RepairMode::fill);
  Correspondence to_dropped = identity_map(with_stray);
  to_dropped.corners(3, 1) = 163;
  EXPECT_THROW((void)image_points(to_dropped, with_stray), std::invalid_argument);
}

}  // namespace
}  // namespace spherematch::test
