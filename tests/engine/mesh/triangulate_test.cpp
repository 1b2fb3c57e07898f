#include "engine/mesh/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "engine/mesh/repair.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::expect_invariants;
using test::expect_refusal;

/// A prism over a regular polygon of `sides` corners.
PolygonMesh prism(std::int32_t sides) {
  Points vertices(2 * sides, 3);
  std::vector<std::vector<std::int32_t>> faces(2);
  for (std::int32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    vertices.row(i) << std::cos(angle), std::sin(angle), 0;
    vertices.row(sides + i) << std::cos(angle), std::sin(angle), 1;
    const std::int32_t next = (i + 1) % sides;
    faces[0].push_back(sides - 1 - i);
    faces[1].push_back(sides + i);
    faces.push_back({i, next, sides + next, sides + i});
  }
  return test::polygons(vertices, faces);
}

TEST(Triangulate, PolygonsKeepToTheirOwnCorners) {
  for (const PolygonMesh& mesh : {test::cube(), prism(3), prism(7), prism(40)}) {
    const Surface surface = repair(mesh, RepairMode::none);
    expect_invariants(surface, mesh);
    EXPECT_EQ(surface.report, RepairReport{});
    EXPECT_EQ(surface.mesh.vertex_count(), mesh.vertex_count());
    for (Eigen::Index f = 0; f < surface.mesh.face_count(); ++f) {
      bool within = false;
      for (std::int32_t p = 0; p < mesh.face_count(); ++p) {
        const std::set<std::int32_t> corners(mesh.face(p).begin(), mesh.face(p).end());
        within |= corners.contains(surface.uploaded_corners(f, 0)) && corners.contains(surface.uploaded_corners(f, 1)) &&
                  corners.contains(surface.uploaded_corners(f, 2));
      }
      EXPECT_TRUE(within) << "face " << f;
    }
  }
  EXPECT_NEAR(test::signed_volume(repair(test::cube(), RepairMode::none).mesh), 1, 1e-12);
}

TEST(Triangulate, ManyCornersFallBackToAFan) {
  const PolygonMesh mesh = prism(2000);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.face_count(), 4 * 2000 - 4);
  EXPECT_NEAR(test::signed_volume(surface.mesh), std::numbers::pi, 1e-4);
}

TEST(Triangulate, TwoQuadsOverOneDiagonalTakeDifferentOnes) {
  // Both side quads of this wedge would take the diagonal 0-2, whose ends are nearest.
  Points vertices(6, 3);
  vertices << 0, -0.1, 0, 2, 0, -0.3, 0, 0.1, 0, -2, 0, -0.3, 2, 0, 0.3, 0, 0, -3;
  const PolygonMesh mesh = test::polygons(vertices, {{0, 4, 2, 3}, {0, 1, 2, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}});
  const Surface surface = repair(mesh, RepairMode::none);
  expect_invariants(surface, mesh);
}

TEST(Triangulate, LeavesOutFacesWithRepeatedCornersAndDuplicates) {
  const TriMesh sphere = test::icosphere(1);
  PolygonMesh mesh = test::polygons(sphere);
  const auto add = [&](const std::vector<std::int32_t>& face) {
    mesh.indices.insert(mesh.indices.end(), face.begin(), face.end());
    mesh.offsets.push_back(static_cast<std::int32_t>(mesh.indices.size()));
  };
  add({3, 3, 4});
  add({3, 4, 3});
  add({sphere.faces(8, 1), sphere.faces(8, 2), sphere.faces(8, 0)});
  add({sphere.faces(9, 1), sphere.faces(9, 0), sphere.faces(9, 2)});
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.faces, sphere.faces);
  EXPECT_EQ(surface.report, (RepairReport{.removed_faces = 4}));
  const OffendingElements repeated = expect_refusal(ErrorCode::degenerate, [&] { (void)repair(mesh, RepairMode::none); });
  EXPECT_EQ(repeated.faces, (std::vector<std::int32_t>{80, 81}));
}

TEST(Triangulate, NoneRefusesDuplicatesByTheirPolygons) {
  const TriMesh sphere = test::icosphere(0);
  TriMesh twice = sphere;
  test::resize_faces(twice, 21);
  twice.faces.row(20) << sphere.faces(4, 2), sphere.faces(4, 0), sphere.faces(4, 1);
  const OffendingElements duplicate = expect_refusal(ErrorCode::degenerate, [&] { (void)repair(test::polygons(twice), RepairMode::none); });
  EXPECT_EQ(duplicate.faces, (std::vector<std::int32_t>{20}));
}

TEST(Triangulate, APolygonThatRepeatsACornerLosesIt) {
  PolygonMesh mesh = test::cube();
  // The first face becomes 0 2 2 3 1.
  mesh.indices.insert(mesh.indices.begin() + 1, 2);
  for (std::size_t f = 1; f < mesh.offsets.size(); ++f) ++mesh.offsets[f];
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.face_count(), 12);
  EXPECT_EQ(expect_refusal(ErrorCode::degenerate, [&] { (void)repair(mesh, RepairMode::none); }).faces, (std::vector<std::int32_t>{0}));
}

TEST(Triangulate, EverythingFromBothSidesCountsOnce) {
  const TriMesh sphere = test::icosphere(1);
  TriMesh both = sphere;
  both.faces.resize(2 * sphere.face_count(), 3);
  both.faces << sphere.faces, test::turned_inside_out(sphere).faces;
  const PolygonMesh mesh = test::polygons(both);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.faces, sphere.faces);
  EXPECT_EQ(surface.report, (RepairReport{.removed_faces = 80}));
}

}  // namespace
}  // namespace spherematch
