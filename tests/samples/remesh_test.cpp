#include "samples/remesh.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "samples/marching.h"
#include "tests/samples/meshes.h"

namespace spherematch::samples {
namespace {

/// A ball of radius 10 whose triangles should have edges of length 2.
Flesh ball() {
  const std::vector<BoneRow> rows{{"ball", "", {0, 0, 0}, 1, 2}};
  return {Skeleton(rows), {{1, false, {{"ball", 1, {{0, 0, 0}, 10, {0, 0, 0}, 10}}}}}};
}

TEST(SamplesMarching, MakesAClosedMeshNearTheSurface) {
  for (const double shift : {0.0, 0.3}) {
    const Mesh mesh = march(ball(), 1.5, shift);
    EXPECT_NO_THROW(SurfaceMesh{mesh});
    EXPECT_EQ(static_cast<long>(mesh.vertices.size()) - static_cast<long>(mesh.triangles.size()) / 2, 2);
    for (const Vec3& p : mesh.vertices) EXPECT_NEAR(norm(p), 10, 0.1);
    const SurfaceMesh surface(mesh);
    for (int h = 0; h < surface.halfedge_count(); h += 3) EXPECT_GE(dot(surface.area_vector(h), surface.position(surface.origin(h))), 0);
  }
}

TEST(SamplesRemesh, GoodTrianglesOfTheWantedSizeOnTheSurface) {
  const Flesh flesh = ball();
  const Mesh mesh = remesh_with(flesh, remesh(flesh, march(flesh, 1.5, 0.3), 0.9), 0.9, {}).mesh;
  const SurfaceMesh surface(mesh);
  double length = 0;
  for (int h = 0; h < surface.halfedge_count(); ++h) length += surface.length(h) / surface.halfedge_count();
  EXPECT_NEAR(length, 1.8, 0.2);
  for (const Vec3& p : mesh.vertices) EXPECT_NEAR(norm(p), 10, 1e-6);
  EXPECT_EQ(share_below(smallest_angles(mesh), 30), 0);
}

TEST(SamplesRemesh, PinnedPointsAreVerticesExactly) {
  const Flesh flesh = ball();
  const Mesh start = remesh(flesh, march(flesh, 1.5, 0.3), 1);
  const std::vector<Vec3> points{flesh.project({1, 2, 9}), flesh.project({-7, 7, 1}), flesh.project({4, -8, -5})};
  const PinnedMesh result = remesh_with(flesh, start, 1, points);
  ASSERT_EQ(result.pinned.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(result.mesh.vertices[static_cast<std::size_t>(result.pinned[i])], points[i]);
  EXPECT_NO_THROW(SurfaceMesh{result.mesh});
  EXPECT_EQ(share_below(smallest_angles(result.mesh), 20), 0);
}

TEST(SamplesRemesh, TwoPointsInOnePlaceAreRefused) {
  const Flesh flesh = ball();
  EXPECT_THROW((void)remesh_with(flesh, remesh(flesh, march(flesh, 1.5, 0.3), 1), 1, {{10, 0, 0}, {10, 0, 0}}), std::invalid_argument);
}

}  // namespace
}  // namespace spherematch::samples
