#include "engine/mesh/fill_holes.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "engine/mesh/repair.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::expect_invariants;
using test::expect_refusal;

std::vector<std::int32_t> faces_where(const TriMesh& mesh, const std::function<bool(const Eigen::RowVector3d&)>& inside) {
  std::vector<std::int32_t> faces;
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const Eigen::RowVector3d centre =
        (mesh.vertices.row(mesh.faces(f, 0)) + mesh.vertices.row(mesh.faces(f, 1)) + mesh.vertices.row(mesh.faces(f, 2))) / 3;
    if (inside(centre)) faces.push_back(f);
  }
  return faces;
}

TEST(FillHoles, LoopsAreClosedOverTheirOwnVertices) {
  const TriMesh sphere = test::icosphere(3);
  const std::vector<std::int32_t> removed = faces_where(
      sphere, [](const Eigen::RowVector3d& p) { return p.z() > 0.9 || p.z() < -0.8 || (p - Eigen::RowVector3d(1, 0, 0)).norm() < 0.2; });
  const PolygonMesh mesh = test::polygons(test::without_faces(sphere, removed));
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.report.filled_loops, 3);
  EXPECT_EQ(surface.report.added_vertices, 0);
  EXPECT_GT(surface.report.added_faces, 20);
  EXPECT_GT(surface.report.dropped_vertices, 0);  // vertices inside the holes
  EXPECT_GE(surface.uploaded_corners.minCoeff(), 0);
  // The faces of the upload come first, as they were.
  EXPECT_EQ(surface.uploaded_corners.topRows(mesh.face_count()), test::without_faces(sphere, removed).faces);
  EXPECT_EQ(surface.mesh.face_count(), mesh.face_count() + surface.report.added_faces);
  // The patches are flat caps: the volume is that of the ball less the three caps.
  EXPECT_NEAR(test::signed_volume(surface.mesh), 4.0 / 3 * std::numbers::pi, 0.2);
  EXPECT_LT(test::total_area(surface.mesh), 4 * std::numbers::pi);
}

TEST(FillHoles, NoneNamesBoundaryEdges) {
  const TriMesh sphere = test::icosphere(1);
  const std::vector<std::int32_t> removed{11};
  const OffendingElements elements =
      expect_refusal(ErrorCode::not_closed, [&] { (void)repair(test::polygons(test::without_faces(sphere, removed)), RepairMode::none); });
  ASSERT_EQ(elements.edges.size(), 3U);
  const std::set<std::int32_t> corners{sphere.faces(11, 0), sphere.faces(11, 1), sphere.faces(11, 2)};
  for (const auto& [a, b] : elements.edges) EXPECT_TRUE(corners.contains(a) && corners.contains(b) && a < b);
  expect_refusal(ErrorCode::not_closed, [] { (void)repair(test::polygons(test::open_disk(6)), RepairMode::none); });
}

TEST(FillHoles, ADiskIsClosed) {
  const PolygonMesh mesh = test::polygons(test::open_disk(6));
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.report, (RepairReport{.filled_loops = 1, .added_faces = 34}));
}

TEST(FillHoles, ALongLoopGetsAFanRoundAnAddedVertex) {
  const PolygonMesh mesh = test::polygons(test::open_disk(100));
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.report, (RepairReport{.filled_loops = 1, .added_vertices = 1, .added_faces = 600}));
  EXPECT_EQ(surface.mesh.vertex_count(), mesh.vertex_count() + 1);
  EXPECT_EQ((surface.uploaded_corners.array() < 0).count(), 600);
  for (Eigen::Index f = mesh.face_count(); f < surface.mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(surface.uploaded_corners(f, k) < 0, surface.mesh.faces(f, k) == mesh.vertex_count());
}

TEST(FillHoles, AChordThatIsAnEdgeIsNotUsed) {
  // A square pyramid's side without its base, and a ridge over the base that is the edge between two of the base's corners: the base
  // can only be closed with the other diagonal.
  Points vertices(4, 3);
  vertices << 0, 0, 0, 1, 0, 0.2, 1, 1, 0, 0, 1, 0.2;
  const PolygonMesh bent = test::polygons(vertices, {{0, 1, 2}, {0, 2, 3}});
  const Surface surface = repair(bent, RepairMode::fill);
  expect_invariants(surface, bent);
  EXPECT_EQ(surface.mesh.face_count(), 4);
  EXPECT_EQ(surface.report.added_vertices, 0);
}

TEST(FillHoles, ManyLoopsStayFast) {
  const TriMesh sphere = test::icosphere(6);
  std::vector<char> used(static_cast<std::size_t>(sphere.vertex_count()), 0);
  TriMesh open = sphere;
  Eigen::Index kept = 0;
  std::int32_t loops = 0;
  for (Eigen::Index f = 0; f < sphere.face_count(); ++f) {
    bool free = true;
    for (int k = 0; k < 3; ++k) free = free && used[static_cast<std::size_t>(sphere.faces(f, k))] == 0;
    if (!free) {
      open.faces.row(kept++) = sphere.faces.row(f);
      continue;
    }
    for (int k = 0; k < 3; ++k) used[static_cast<std::size_t>(sphere.faces(f, k))] = 1;
    ++loops;
  }
  test::resize_faces(open, kept);
  const PolygonMesh mesh = test::polygons(open);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_GT(loops, 5000);
  EXPECT_EQ(surface.report, (RepairReport{.filled_loops = loops, .added_faces = loops}));
}

}  // namespace
}  // namespace spherematch
