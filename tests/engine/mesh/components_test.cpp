#include "engine/mesh/components.h"

#include <gtest/gtest.h>

#include "engine/mesh/repair.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::expect_invariants;
using test::expect_refusal;

TriMesh scaled(const TriMesh& mesh, double scale, double shift) {
  return test::transformed(mesh, scale, Eigen::Matrix3d::Identity(), {shift, 0, 0});
}

TEST(Components, TheLargestByAreaIsKept) {
  // The smaller sphere has more faces and comes first.
  const TriMesh fine = scaled(test::icosphere(3), 0.5, 0);
  const TriMesh coarse = scaled(test::icosphere(1), 1.0, 3);
  const PolygonMesh mesh = test::polygons(test::joined(fine, coarse));
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.faces, coarse.faces);
  EXPECT_EQ(surface.report, (RepairReport{.dropped_vertices = 642, .removed_faces = 1280, .dropped_components = 1}));
  EXPECT_EQ(surface.surface_vertex[0], -1);
  EXPECT_EQ(surface.surface_vertex[642], 0);
  EXPECT_EQ(surface.uploaded_corners(0, 0), coarse.faces(0, 0) + 642);
}

TEST(Components, TheFirstOfEqualsIsKept) {
  const PolygonMesh mesh = test::polygons(test::joined(test::tetrahedron(), test::tetrahedron()));
  EXPECT_EQ(repair(mesh, RepairMode::fill).surface_vertex, (std::vector<std::int32_t>{0, 1, 2, 3, -1, -1, -1, -1}));
}

TEST(Components, NoneNamesAFaceOfEachSmallerOne) {
  const TriMesh two = test::joined(scaled(test::tetrahedron(), 0.1, 5), test::icosphere(1));
  const TriMesh three = test::joined(two, scaled(test::tetrahedron(), 0.2, -5));
  const OffendingElements elements =
      expect_refusal(ErrorCode::disconnected, [&] { (void)repair(test::polygons(three), RepairMode::none); });
  EXPECT_EQ(elements.faces, (std::vector<std::int32_t>{0, 84}));
}

TEST(Components, WhatGoesMayBeUnusable) {
  // Neither an open nor a one-sided component is an obstacle when it is not the one that is kept.
  TriMesh all = test::joined(test::icosphere(2), scaled(test::klein_bottle(8, 6), 0.05, 4));
  all = test::joined(all, scaled(test::open_disk(3), 0.3, -4));
  const PolygonMesh mesh = test::polygons(all);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.report.dropped_components, 2);
  EXPECT_EQ(surface.report.filled_loops, 0);
  EXPECT_EQ(surface.report.flipped_faces, 0);
}

TEST(Components, AVertexWithoutAFaceIsDropped) {
  TriMesh mesh = test::icosphere(1);
  test::resize_vertices(mesh, 44);
  mesh.vertices.bottomRows(2).setConstant(9);
  const std::vector<std::int32_t> order = test::shuffled(44, 3);
  mesh = test::renumbered(mesh, order);
  const PolygonMesh upload = test::polygons(mesh);
  const Surface surface = repair(upload, RepairMode::fill);
  expect_invariants(surface, upload);
  EXPECT_EQ(surface.report, (RepairReport{.dropped_vertices = 2}));
  const OffendingElements elements = expect_refusal(ErrorCode::disconnected, [&] { (void)repair(upload, RepairMode::none); });
  ASSERT_EQ(elements.vertices.size(), 2U);
  for (const std::int32_t v : elements.vertices) EXPECT_EQ(upload.vertices(v, 0), 9);
}

TEST(Components, NoAreaIsRefused) {
  Points line(5, 3);
  for (int v = 0; v < 5; ++v) line.row(v) << v, v, 2 * v;
  const PolygonMesh mesh = test::polygons(line, {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}});
  for (const RepairMode mode : {RepairMode::fill, RepairMode::none})
    expect_refusal(mode == RepairMode::fill ? ErrorCode::degenerate : ErrorCode::not_closed, [&] { (void)repair(mesh, mode); });
}

}  // namespace
}  // namespace spherematch
