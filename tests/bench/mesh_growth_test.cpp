#include "bench/mesh_growth.h"

#include <gtest/gtest.h>

#include "engine/mesh/topology.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch::bench {
namespace {

double longest_edge(const TriMesh& mesh) {
  double longest = 0;
  for (Eigen::Index face = 0; face < mesh.face_count(); ++face) {
    for (int k = 0; k < 3; ++k) {
      const auto edge = mesh.vertices.row(mesh.faces(face, k)) - mesh.vertices.row(mesh.faces(face, (k + 1) % 3));
      longest = std::max(longest, edge.norm());
    }
  }
  return longest;
}

void expect_closed_sphere(const TriMesh& mesh) {
  EXPECT_EQ(mesh.face_count(), 2 * mesh.vertex_count() - 4);
  EXPECT_EQ(euler_characteristic(mesh.faces), 2);
  EXPECT_GE(face_neighbours(mesh.faces).minCoeff(), 0);
}

TEST(MeshGrowth, HasExactlyTheWantedNumberOfVertices) {
  const TriMesh body = test::creature(3);
  for (const int extra : {1, 2, 3, 1000, 20000}) {
    const TriMesh grown = subdivided(body, static_cast<std::int32_t>(body.vertex_count()) + extra);
    EXPECT_EQ(grown.vertex_count(), body.vertex_count() + extra);
    expect_closed_sphere(grown);
  }
}

TEST(MeshGrowth, KeepsTheSurfaceAndItsVertices) {
  const TriMesh body = test::creature(3);
  const TriMesh grown = subdivided(body, 10'000);
  EXPECT_EQ(grown.vertices.topRows(body.vertex_count()), body.vertices);
  EXPECT_NEAR(test::total_area(grown), test::total_area(body), 1e-12 * test::total_area(body));
  EXPECT_NEAR(test::signed_volume(grown), test::signed_volume(body), 1e-12 * test::signed_volume(body));
}

TEST(MeshGrowth, HalvesTheLongestEdgeFirst) {
  const TriMesh long_body = test::ellipsoid(2, {1, 1, 20});
  const double before = longest_edge(long_body);
  double last = before;
  for (const std::int32_t vertices : {500, 1000, 2000, 4000}) {
    const double now = longest_edge(subdivided(long_body, vertices));
    EXPECT_LT(now, last);
    last = now;
  }
  EXPECT_LT(last, before / 4);
}

TEST(MeshGrowth, IsTheSameEachTime) {
  // All edges of a level are equally long but for rounding, so that the order hangs on how ties are broken.
  const TriMesh ball = test::icosphere(3);
  const TriMesh first = subdivided(ball, 3333);
  const TriMesh second = subdivided(ball, 3333);
  EXPECT_EQ(first.vertices, second.vertices);
  EXPECT_EQ(first.faces, second.faces);
}

TEST(MeshGrowth, LeavesAMeshThatIsLargeEnough) {
  const TriMesh body = test::creature(3);
  EXPECT_EQ(subdivided(body, 10).vertices, body.vertices);
  EXPECT_EQ(resized(body, static_cast<std::int32_t>(body.vertex_count())).faces, body.faces);
}

TEST(MeshGrowth, ResizesDownwards) {
  const TriMesh body = test::creature(4);
  const TriMesh small = resized(body, 700);
  EXPECT_EQ(small.vertex_count(), 700);
  expect_closed_sphere(small);
}

TEST(MeshGrowth, RefusesAnOpenMesh) { EXPECT_THROW((void)subdivided(test::open_disk(4), 1000), std::runtime_error); }

}  // namespace
}  // namespace spherematch::bench
