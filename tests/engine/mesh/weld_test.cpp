#include "engine/mesh/weld.h"

#include <gtest/gtest.h>

#include "engine/mesh/repair.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::expect_invariants;
using test::expect_refusal;

TEST(Weld, TriangleSoupBecomesOneSurface) {
  const TriMesh body = test::creature(2);
  const PolygonMesh mesh = test::polygons(test::triangle_soup(body));
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.vertex_count(), body.vertex_count());
  EXPECT_EQ(surface.mesh.face_count(), body.face_count());
  EXPECT_EQ(surface.report, (RepairReport{.welded_vertices = static_cast<std::int32_t>(3 * body.face_count() - body.vertex_count())}));
  // The corners are those of the upload, not those that they were welded to.
  EXPECT_EQ(surface.uploaded_corners, test::triangle_soup(body).faces);
  expect_refusal(ErrorCode::not_closed, [&] { (void)repair(mesh, RepairMode::none); });
}

TEST(Weld, ZeroAndMinusZeroCoincide) {
  TriMesh soup = test::triangle_soup(test::tetrahedron());
  for (Eigen::Index v = 0; v < soup.vertex_count(); v += 2)
    for (int k = 0; k < 3; ++k)
      if (soup.vertices(v, k) == 0) soup.vertices(v, k) = -0.0;
  const PolygonMesh mesh = test::polygons(soup);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.report.welded_vertices, 8);
}

TEST(Weld, ASoupWithTurnedAndRepeatedTriangles) {
  const TriMesh body = test::icosphere(1);
  TriMesh soup = test::triangle_soup(body);
  for (Eigen::Index f = 0; f < soup.face_count(); f += 3) std::swap(soup.faces(f, 0), soup.faces(f, 1));
  TriMesh repeated = test::triangle_soup(body);
  test::resize_faces(repeated, 10);
  const PolygonMesh mesh = test::polygons(test::joined(soup, repeated));
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.vertex_count(), 42);
  EXPECT_EQ(surface.mesh.face_count(), 80);
  EXPECT_EQ(surface.report.removed_faces, 10);
  EXPECT_EQ(surface.report.flipped_faces, 27);
}

TEST(Weld, ASeamIsWeldedAlongItsEdgesOnly) {
  // A sphere slit along a chain of edges; the two ends of the slit are not doubled.
  TriMesh sphere = test::icosphere(2);
  const std::int32_t centre = sphere.faces(20, 0);
  std::int32_t copies = 0;
  for (Eigen::Index f = 0; f < sphere.face_count() && copies < 2; ++f)
    for (int k = 0; k < 3; ++k)
      if (sphere.faces(f, k) == centre) {
        test::resize_vertices(sphere, sphere.vertex_count() + 1);
        sphere.vertices.row(sphere.vertex_count() - 1) = sphere.vertices.row(centre);
        sphere.faces(f, k) = static_cast<std::int32_t>(sphere.vertex_count() - 1);
        ++copies;
        break;
      }
  const PolygonMesh mesh = test::polygons(sphere);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.vertex_count(), 162);
  EXPECT_EQ(surface.report, (RepairReport{.welded_vertices = 2}));
}

TEST(Weld, TouchingSheetsOfAClosedMeshStayDistinct) {
  TriMesh sphere = test::icosphere(2);
  Eigen::Index top = 0;
  Eigen::Index bottom = 0;
  sphere.vertices.col(2).maxCoeff(&top);
  sphere.vertices.col(2).minCoeff(&bottom);
  sphere.vertices.row(top).setZero();
  sphere.vertices.row(bottom).setZero();
  const PolygonMesh mesh = test::polygons(sphere);
  for (const RepairMode mode : {RepairMode::fill, RepairMode::none}) {
    const Surface surface = repair(mesh, mode);
    expect_invariants(surface, mesh);
    EXPECT_EQ(surface.mesh.faces, sphere.faces);
    EXPECT_EQ(surface.report, RepairReport{});
  }
}

TEST(Weld, ABoundaryVertexIsNotWeldedToASheetItTouches) {
  // A vertex of the hole's rim lies where a vertex on the other side of the sphere does.
  const TriMesh sphere = test::icosphere(2);
  const std::vector<std::int32_t> removed{0};
  TriMesh open = test::without_faces(sphere, removed);
  Eigen::Index opposite = 0;
  (sphere.vertices * sphere.vertices.row(sphere.faces(0, 0)).transpose()).minCoeff(&opposite);
  open.vertices.row(opposite) = open.vertices.row(sphere.faces(0, 0));
  const PolygonMesh mesh = test::polygons(open);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.report, (RepairReport{.filled_loops = 1, .added_faces = 1}));
}

TEST(Weld, AWeldThatWouldDoubleAnEdgeIsNotMade) {
  // A hole with a rim whose every second vertex lies in one place: its edges coincide in pairs, and welding them all would join
  // vertices that have edges to the same neighbours.
  const TriMesh sphere = test::icosphere(1);
  const std::int32_t hub = sphere.faces(3, 0);
  std::vector<std::int32_t> round;
  for (std::int32_t f = 0; f < sphere.face_count(); ++f)
    if ((sphere.faces.row(f).array() == hub).any()) round.push_back(f);
  TriMesh open = test::without_faces(sphere, round);
  // Every second vertex of the rim is moved onto one place.
  std::vector<std::int32_t> rim;
  for (const std::int32_t f : round)
    for (int k = 0; k < 3; ++k)
      if (sphere.faces(f, k) != hub) rim.push_back(sphere.faces(f, k));
  std::sort(rim.begin(), rim.end());
  rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
  for (std::size_t i = 0; i < rim.size(); i += 2) open.vertices.row(rim[i]) = open.vertices.row(rim[0]);
  const PolygonMesh mesh = test::polygons(open);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
}

}  // namespace
}  // namespace spherematch
