#include "engine/mesh/orient.h"

#include <gtest/gtest.h>

#include "engine/mesh/repair.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::expect_invariants;
using test::expect_refusal;

TEST(Orient, FacesOfMixedOrientationAreTurned) {
  const TriMesh body = test::creature(2);
  TriMesh mixed = body;
  std::int32_t turned = 0;
  for (Eigen::Index f = 0; f < body.face_count(); ++f)
    if ((f * f) % 7 < 3) {
      std::swap(mixed.faces(f, 1), mixed.faces(f, 2));
      ++turned;
    }
  const PolygonMesh mesh = test::polygons(mixed);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.faces, body.faces);
  EXPECT_EQ(surface.uploaded_corners, body.faces);
  EXPECT_EQ(surface.report, (RepairReport{.flipped_faces = turned}));
  const OffendingElements elements = expect_refusal(ErrorCode::inconsistent_orientation, [&] { (void)repair(mesh, RepairMode::none); });
  EXPECT_EQ(elements.edges.size(), 20U);
}

TEST(Orient, FacesThatPointInwardAreTurned) {
  const TriMesh body = test::transformed(test::creature(2), 1, test::some_rotation(), {100, 0, -50});
  const PolygonMesh mesh = test::polygons(test::turned_inside_out(body));
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.faces, body.faces);
  EXPECT_EQ(surface.report, (RepairReport{.flipped_faces = 320}));
  expect_refusal(ErrorCode::inconsistent_orientation, [&] { (void)repair(mesh, RepairMode::none); });
}

TEST(Orient, OneSidedSurfacesAreRefused) {
  TriMesh moebius = test::klein_bottle(12, 8);
  // Half of the tube's cells are a Moebius band round the ring.
  std::vector<std::int32_t> half;
  for (std::int32_t f = 0; f < moebius.face_count(); ++f)
    if ((f / 2) % 8 >= 2 && (f / 2) % 8 < 6) half.push_back(f);
  const TriMesh band = test::without_faces(moebius, half);
  for (const TriMesh& mesh : {test::klein_bottle(12, 8), band}) {
    const OffendingElements elements =
        expect_refusal(ErrorCode::inconsistent_orientation, [&] { (void)repair(test::polygons(mesh), RepairMode::fill); });
    EXPECT_FALSE(elements.edges.empty());
    expect_refusal(ErrorCode::inconsistent_orientation, [&] { (void)repair(test::polygons(mesh), RepairMode::none); });
  }
}

TEST(Orient, FlatSurfacesAreRefused) {
  TriMesh flat = test::open_disk(3);
  flat.vertices.col(2).setZero();
  flat = test::transformed(flat, 1, test::some_rotation(), {1, 2, 3});
  expect_refusal(ErrorCode::degenerate, [&] { (void)repair(test::polygons(flat), RepairMode::fill); });
  TriMesh pressed = test::icosphere(2);
  pressed.vertices.col(1).setZero();
  for (const RepairMode mode : {RepairMode::fill, RepairMode::none})
    expect_refusal(ErrorCode::degenerate, [&] { (void)repair(test::polygons(pressed), mode); });
}

TEST(Orient, ThinSurfacesAreNot) {
  const PolygonMesh mesh = test::polygons(test::ellipsoid(3, {1, 1, 1e-6}));
  for (const RepairMode mode : {RepairMode::fill, RepairMode::none}) expect_invariants(repair(mesh, mode), mesh);
}

TEST(Orient, AWeldThatWouldMakeTheSurfaceOneSidedIsOpened) {
  // A strip whose ends coincide after half a turn: welded it would be a Moebius band.
  TriMesh strip;
  constexpr int cells = 16;
  strip.vertices.resize(2 * (cells + 1), 3);
  strip.faces.resize(2 * cells, 3);
  for (int i = 0; i <= cells; ++i) {
    const double turn = 2 * 3.14159265358979 * i / cells;
    for (int side = 0; side < 2; ++side) {
      const double across = 0.3 * (2 * side - 1);
      strip.vertices.row(2 * i + side) << (1 + across * std::cos(turn / 2)) * std::cos(turn),
          (1 + across * std::cos(turn / 2)) * std::sin(turn), across * std::sin(turn / 2);
    }
  }
  strip.vertices.row(2 * cells) = strip.vertices.row(1);
  strip.vertices.row(2 * cells + 1) = strip.vertices.row(0);
  for (int i = 0; i < cells; ++i) {
    strip.faces.row(2 * i) << 2 * i, 2 * i + 2, 2 * i + 3;
    strip.faces.row(2 * i + 1) << 2 * i, 2 * i + 3, 2 * i + 1;
  }
  const PolygonMesh mesh = test::polygons(strip);
  try {
    const Surface surface = repair(mesh, RepairMode::fill);
    expect_invariants(surface, mesh);
    EXPECT_EQ(surface.report.welded_vertices, 0);
    EXPECT_EQ(surface.report.filled_loops, 1);
  } catch (const EngineError& error) {
    FAIL() << error.what();
  }
}

}  // namespace
}  // namespace spherematch
