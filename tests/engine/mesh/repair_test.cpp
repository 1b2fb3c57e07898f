#include "engine/mesh/repair.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::expect_invariants;
using test::expect_refusal;

TEST(Repair, ACleanMeshStaysAsItIs) {
  const std::vector<std::int32_t> order = test::shuffled(642, 5);
  for (const TriMesh& clean : {test::tetrahedron(), test::icosphere(0), test::renumbered(test::icosphere(3), order), test::creature(4),
                               test::transformed(test::creature(2), 1e-20, test::some_rotation(), {0, 0, 0}),
                               test::transformed(test::creature(2), 1e20, test::some_rotation(), {1e21, 0, 0})}) {
    const PolygonMesh mesh = test::polygons(clean);
    for (const RepairMode mode : {RepairMode::fill, RepairMode::none}) {
      const Surface surface = repair(mesh, mode);
      expect_invariants(surface, mesh);
      EXPECT_EQ(surface.mesh.vertices, clean.vertices);
      EXPECT_EQ(surface.mesh.faces, clean.faces);
      EXPECT_EQ(surface.uploaded_corners, clean.faces);
      EXPECT_EQ(surface.report, RepairReport{});
      for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) EXPECT_EQ(surface.surface_vertex[static_cast<std::size_t>(v)], v);
    }
  }
}

TEST(Repair, WrongGenusIsNamed) {
  for (const RepairMode mode : {RepairMode::fill, RepairMode::none}) try {
      (void)repair(test::polygons(test::torus(12, 8)), mode);
      FAIL() << "not refused";
    } catch (const EngineError& error) {
      EXPECT_EQ(error.code(), ErrorCode::wrong_genus);
      EXPECT_NE(std::string(error.what()).find("genus 1"), std::string::npos) << error.what();
    }
}

TEST(Repair, GenusCountsAfterFilling) {
  // A torus cut open along its tube is a sphere once both ends are closed.
  const TriMesh torus = test::torus(12, 8);
  std::vector<std::int32_t> slice;
  for (std::int32_t f = 0; f < 16; ++f) slice.push_back(f);
  const PolygonMesh mesh = test::polygons(test::without_faces(torus, slice));
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.report, (RepairReport{.filled_loops = 2, .added_faces = 12}));
  // With one face gone it is a torus still.
  const std::vector<std::int32_t> one{3};
  expect_refusal(ErrorCode::wrong_genus, [&] { (void)repair(test::polygons(test::without_faces(torus, one)), RepairMode::fill); });
}

TEST(Repair, RefusesWhatCannotBeComputedWith) {
  for (const RepairMode mode : {RepairMode::fill, RepairMode::none}) {
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
      TriMesh mesh = test::icosphere(1);
      mesh.vertices(7, 1) = value;
      const OffendingElements elements = expect_refusal(ErrorCode::degenerate, [&] { (void)repair(test::polygons(mesh), mode); });
      EXPECT_EQ(elements.vertices, value == 1e300 ? std::vector<std::int32_t>{} : std::vector<std::int32_t>{7});
    }
    TriMesh point = test::icosphere(1);
    point.vertices.setConstant(3);
    expect_refusal(ErrorCode::degenerate, [&] { (void)repair(test::polygons(point), mode); });
    expect_refusal(ErrorCode::degenerate, [&] { (void)repair(PolygonMesh{}, mode); });
    Points three(3, 3);
    three << 0, 0, 0, 1, 0, 0, 0, 1, 0;
    expect_refusal(ErrorCode::degenerate, [&] { (void)repair(test::polygons(three, {{0, 1, 2}}), mode); });
  }
  Points four(4, 3);
  four << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  // One triangle of four vertices, and faces that all drop out.
  expect_refusal(ErrorCode::degenerate, [&] { (void)repair(test::polygons(four, {{0, 1, 2}}), RepairMode::fill); });
  expect_refusal(ErrorCode::degenerate, [&] { (void)repair(test::polygons(four, {{0, 1, 1}, {2, 2, 2}}), RepairMode::fill); });
  expect_refusal(ErrorCode::malformed_mesh, [&] { (void)repair(test::polygons(four, {{0, 1, 4}}), RepairMode::fill); });
  expect_refusal(ErrorCode::malformed_mesh, [&] { (void)repair(test::polygons(four, {{0, 1, -1}}), RepairMode::fill); });
}

TEST(Repair, GivesTheSameTwice) {
  TriMesh body = test::creature(4);
  const std::vector<std::int32_t> removed{5, 6, 7, 100, 900, 901, 2000};
  const PolygonMesh mesh = test::polygons(test::joined(test::without_faces(body, removed), test::triangle_soup(test::icosphere(2))));
  const Surface first = repair(mesh, RepairMode::fill);
  const Surface second = repair(mesh, RepairMode::fill);
  EXPECT_EQ(first.mesh.vertices, second.mesh.vertices);
  EXPECT_EQ(first.mesh.faces, second.mesh.faces);
  EXPECT_EQ(first.uploaded_corners, second.uploaded_corners);
  EXPECT_EQ(first.surface_vertex, second.surface_vertex);
  EXPECT_EQ(first.report, second.report);
}

}  // namespace
}  // namespace spherematch
