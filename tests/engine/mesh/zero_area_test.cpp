#include "engine/mesh/zero_area.h"

#include <gtest/gtest.h>

#include "engine/mesh/repair.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::expect_invariants;
using test::expect_refusal;

std::int64_t zero_area_faces(const TriMesh& mesh) {
  std::int64_t count = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f)
    if (is_zero_area(mesh.vertices.row(mesh.faces(f, 0)), mesh.vertices.row(mesh.faces(f, 1)), mesh.vertices.row(mesh.faces(f, 2))))
      ++count;
  return count;
}

/// Splits the edge from corner 0 to corner 1 of the face as a modeller with a T-junction does that was closed badly: a new vertex in
/// the middle, joined to the edge's ends by a face without area, and the face beyond the edge left as it is.
TriMesh with_cap(const TriMesh& mesh, Eigen::Index face) {
  TriMesh result = mesh;
  const std::int32_t a = mesh.faces(face, 0);
  const std::int32_t b = mesh.faces(face, 1);
  const std::int32_t c = mesh.faces(face, 2);
  const auto middle = static_cast<std::int32_t>(mesh.vertex_count());
  test::resize_vertices(result, middle + 1);
  result.vertices.row(middle) = (mesh.vertices.row(a) + mesh.vertices.row(b)) / 2;
  test::resize_faces(result, mesh.face_count() + 2);
  result.faces.row(face) << a, middle, c;
  result.faces.row(mesh.face_count()) << middle, b, c;
  result.faces.row(mesh.face_count() + 1) << a, b, middle;
  return result;
}

TEST(ZeroArea, IsRelativeToTheLongestSide) {
  for (const double scale : {1e-60, 1.0, 1e60}) {
    const Eigen::Vector3d a(0, 0, 0);
    const Eigen::Vector3d b(scale, scale, 0);
    EXPECT_TRUE(is_zero_area(a, b, 0.3 * b));
    EXPECT_TRUE(is_zero_area(a, a, b));
    EXPECT_TRUE(is_zero_area(a, a, a));
    EXPECT_FALSE(is_zero_area(a, b, 0.3 * b + Eigen::Vector3d(0, 0, 1e-8 * scale)));
  }
}

TEST(ZeroArea, ACapIsFlippedAway) {
  const TriMesh capped = with_cap(test::icosphere(2), 100);
  const PolygonMesh mesh = test::polygons(capped);
  ASSERT_EQ(zero_area_faces(capped), 1);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(zero_area_faces(surface.mesh), 0);
  EXPECT_EQ(surface.mesh.vertex_count(), mesh.vertex_count());
  EXPECT_EQ(surface.mesh.face_count(), mesh.face_count());
  EXPECT_EQ(surface.report, (RepairReport{.removed_faces = 1}));
  // The two new faces are no uploaded triangles.
  EXPECT_EQ((surface.uploaded_corners.array() < 0).count(), 6);
  const OffendingElements elements = expect_refusal(ErrorCode::degenerate, [&] { (void)repair(mesh, RepairMode::none); });
  EXPECT_EQ(elements.faces, (std::vector<std::int32_t>{mesh.face_count() - 1}));
}

TEST(ZeroArea, ManyCapsAreFlippedAway) {
  TriMesh capped = test::transformed(test::icosphere(3), 0.01, test::some_rotation(), {1, 2, 3});
  for (Eigen::Index f = 0; f < 1280; f += 40) capped = with_cap(capped, f);
  const PolygonMesh mesh = test::polygons(capped);
  ASSERT_EQ(zero_area_faces(capped), 32);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(zero_area_faces(surface.mesh), 0);
  EXPECT_EQ(surface.report, (RepairReport{.removed_faces = 32}));
}

TEST(ZeroArea, AnEdgeOfNoLengthIsCollapsed) {
  TriMesh sphere = test::icosphere(2);
  const std::int32_t a = sphere.faces(50, 0);
  const std::int32_t b = sphere.faces(50, 1);
  sphere.vertices.row(b) = sphere.vertices.row(a);
  const PolygonMesh mesh = test::polygons(sphere);
  ASSERT_EQ(zero_area_faces(sphere), 2);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(zero_area_faces(surface.mesh), 0);
  EXPECT_EQ(surface.mesh.vertex_count(), 161);
  EXPECT_EQ(surface.report, (RepairReport{.welded_vertices = 1, .removed_faces = 2}));
  EXPECT_EQ(surface.surface_vertex[static_cast<std::size_t>(a)], surface.surface_vertex[static_cast<std::size_t>(b)]);
  // The faces that are left keep their uploaded corners, those at the vertex that went too.
  EXPECT_GT((surface.uploaded_corners.array() == a).count(), 0);
  EXPECT_GT((surface.uploaded_corners.array() == b).count(), 0);
  EXPECT_EQ(expect_refusal(ErrorCode::degenerate, [&] { (void)repair(mesh, RepairMode::none); }).faces.size(), 2U);
}

TEST(ZeroArea, AWholeFanInOnePlaceIsCollapsed) {
  TriMesh sphere = test::icosphere(3);
  const std::int32_t centre = sphere.faces(200, 0);
  for (Eigen::Index f = 0; f < sphere.face_count(); ++f)
    if ((sphere.faces.row(f).array() == centre).any())
      for (int k = 0; k < 3; ++k) sphere.vertices.row(sphere.faces(f, k)) = sphere.vertices.row(centre);
  const PolygonMesh mesh = test::polygons(sphere);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(zero_area_faces(surface.mesh), 0);
  EXPECT_EQ(surface.report.welded_vertices, 642 - surface.mesh.vertex_count());
}

TEST(ZeroArea, ASlitClosedByATJunctionIsMended) {
  // One side of an edge is split, the other is not: a boundary loop of three collinear vertices.
  TriMesh slit = with_cap(test::icosphere(2), 100);
  test::resize_faces(slit, slit.face_count() - 1);
  const PolygonMesh mesh = test::polygons(slit);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(zero_area_faces(surface.mesh), 0);
  EXPECT_EQ(surface.report.filled_loops, 1);
  EXPECT_EQ(surface.report.added_vertices, 0);
}

TEST(ZeroArea, WhatCannotBeRemovedStays) {
  // A tetrahedron with a vertex on its edge 0-1: the flip would make the edge between the vertex and the opposite corner twice.
  TriMesh mesh = test::tetrahedron();
  mesh.vertices.row(3) = 0.5 * (mesh.vertices.row(0) + mesh.vertices.row(1)) + Eigen::RowVector3d(0, 0, 0);
  const PolygonMesh flat = test::polygons(mesh);
  expect_refusal(ErrorCode::degenerate, [&] { (void)repair(flat, RepairMode::fill); });  // and it encloses nothing

  // In a larger body the same needle stays, and the surface is whole.
  TriMesh body = test::icosphere(1);
  const std::int32_t a = body.faces(0, 0);
  const std::int32_t b = body.faces(0, 1);
  const std::int32_t c = body.faces(0, 2);
  const auto inner = static_cast<std::int32_t>(body.vertex_count());
  test::resize_vertices(body, inner + 1);
  body.vertices.row(inner) = body.vertices.row(a);
  body.faces.row(0) << a, b, inner;
  test::resize_faces(body, body.face_count() + 2);
  body.faces.row(body.face_count() - 2) << b, c, inner;
  body.faces.row(body.face_count() - 1) << c, a, inner;
  const PolygonMesh needle = test::polygons(body);
  const Surface surface = repair(needle, RepairMode::fill);
  expect_invariants(surface, needle);
}

}  // namespace
}  // namespace spherematch
