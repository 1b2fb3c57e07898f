#include "engine/mesh/glue.h"

#include <gtest/gtest.h>

#include "engine/mesh/repair.h"
#include "engine/mesh/weld.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::expect_invariants;
using test::expect_refusal;

/// `b` with its vertices `shared` replaced by vertices of `a`: pairs (vertex of a, vertex of b).
TriMesh sharing(const TriMesh& a, const TriMesh& b, const std::vector<std::pair<std::int32_t, std::int32_t>>& shared) {
  TriMesh result = test::joined(a, b);
  for (const auto& [of_a, of_b] : shared)
    for (Eigen::Index i = 0; i < result.faces.size(); ++i)
      if (result.faces.data()[i] == of_b + a.vertex_count()) result.faces.data()[i] = of_a;
  return result;
}

/// Two cubes of triangles, the second smaller, that touch along the edge of the first from (1, 1, 0) to (1, 1, 1).
PolygonMesh cubes_touching_at_an_edge() {
  const PolygonMesh cube = test::cube();
  Points vertices(14, 3);
  vertices.topRows(8) = cube.vertices;
  vertices.bottomRows(6) << 1.5, 1, 0, 1, 1.5, 0, 1.5, 1.5, 0, 1.5, 1, 1, 1, 1.5, 1, 1.5, 1.5, 1;
  std::vector<std::vector<std::int32_t>> faces;
  for (std::int32_t f = 0; f < 6; ++f) faces.emplace_back(cube.face(f).begin(), cube.face(f).end());
  // Numbers of the second cube's corners in the order of the first's.
  const std::vector<std::int32_t> second{3, 8, 9, 10, 7, 11, 12, 13};
  for (std::int32_t f = 0; f < 6; ++f) {
    faces.emplace_back();
    for (const std::int32_t corner : cube.face(f)) faces.back().push_back(second[static_cast<std::size_t>(corner)]);
  }
  return test::polygons(vertices, faces);
}

TEST(Glue, SolidsThatTouchAtAVertexComeApart) {
  const TriMesh large = test::icosphere(2);
  const TriMesh small = test::transformed(test::icosphere(1), 0.5, Eigen::Matrix3d::Identity(), {0, 0, 0});
  const PolygonMesh mesh = test::polygons(sharing(large, small, {{5, 7}}));
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.faces, large.faces);
  EXPECT_EQ(surface.report.split_vertices, 1);
  EXPECT_EQ(surface.report.dropped_components, 1);
  EXPECT_EQ(surface.report.removed_faces, 80);
  EXPECT_EQ(surface.report.dropped_vertices, 42);  // the vertex that went into the large sphere has no face of its own number
  EXPECT_EQ(surface.report.welded_vertices, 0);
  const OffendingElements elements = expect_refusal(ErrorCode::non_manifold, [&] { (void)repair(mesh, RepairMode::none); });
  EXPECT_EQ(elements.vertices, (std::vector<std::int32_t>{5}));
}

TEST(Glue, APinchedSphereBecomesTwoVerticesInOnePlace) {
  // A hole of two faces on either side of the sphere, joined by a tube pinched to one vertex: one surface, one vertex too few.
  TriMesh sphere = test::icosphere(2);
  const std::int32_t south = [&] {
    Eigen::Index lowest = 0;
    sphere.vertices.col(2).minCoeff(&lowest);
    return static_cast<std::int32_t>(lowest);
  }();
  Eigen::Index highest = 0;
  sphere.vertices.col(2).maxCoeff(&highest);
  const auto north = static_cast<std::int32_t>(highest);
  sphere.vertices.row(south).setZero();
  sphere.vertices.row(north).setZero();
  for (Eigen::Index i = 0; i < sphere.faces.size(); ++i)
    if (sphere.faces.data()[i] == south) sphere.faces.data()[i] = north;
  const PolygonMesh mesh = test::polygons(sphere);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.vertex_count(), 162);
  EXPECT_EQ(surface.report, (RepairReport{.dropped_vertices = 1, .split_vertices = 1}));
  EXPECT_EQ(expect_refusal(ErrorCode::non_manifold, [&] { (void)repair(mesh, RepairMode::none); }).vertices,
            (std::vector<std::int32_t>{north}));
}

TEST(Glue, SolidsThatTouchAtAnEdgeComeApart) {
  for (const bool inside_out : {false, true}) {
    PolygonMesh mesh = cubes_touching_at_an_edge();
    if (inside_out)
      for (std::int32_t f = 0; f < mesh.face_count(); ++f)
        std::reverse(mesh.indices.begin() + mesh.offsets[static_cast<std::size_t>(f)],
                     mesh.indices.begin() + mesh.offsets[static_cast<std::size_t>(f) + 1]);
    const Surface surface = repair(mesh, RepairMode::fill);
    expect_invariants(surface, mesh);
    EXPECT_EQ(surface.mesh.vertex_count(), 8);
    EXPECT_NEAR(test::signed_volume(surface.mesh), 1, 1e-12);
    EXPECT_EQ(surface.report.dropped_components, 1);
    EXPECT_EQ(surface.report.split_vertices, 2);
    EXPECT_EQ(surface.report.filled_loops, 0);
    const OffendingElements elements = expect_refusal(ErrorCode::non_manifold, [&] { (void)repair(mesh, RepairMode::none); });
    ASSERT_EQ(elements.edges.size(), 1U);
    EXPECT_EQ(elements.edges[0], (std::array<std::int32_t, 2>{3, 7}));
  }
}

TEST(Glue, AFinIsCutOff) {
  const TriMesh sphere = test::icosphere(1);
  TriMesh finned = sphere;
  test::resize_vertices(finned, 43);
  finned.vertices.row(42) = 2 * sphere.vertices.row(sphere.faces(0, 0));
  test::resize_faces(finned, 81);
  finned.faces.row(80) << sphere.faces(0, 0), sphere.faces(0, 1), 42;
  const PolygonMesh mesh = test::polygons(finned);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.faces, sphere.faces);
  EXPECT_EQ(surface.surface_vertex[42], -1);
  EXPECT_EQ(surface.report.removed_faces, 1);
  EXPECT_EQ(surface.report.filled_loops, 0);
}

TEST(Glue, AWallInsideIsCutOff) {
  // The double pyramid keeps its outside when its equator is spanned by a square of two triangles.
  Points vertices(6, 3);
  vertices << 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  const PolygonMesh mesh =
      test::polygons(vertices, {{0, 1, 2, 3}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}});
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.face_count(), 8);
  EXPECT_EQ(surface.report.removed_faces, 2);
  EXPECT_EQ(surface.report.added_faces, 0);
  EXPECT_NEAR(test::signed_volume(surface.mesh), 4.0 / 3, 1e-12);
}

TEST(Glue, DentsThatTouchAtAnEdgeComeApart) {
  // An edge in the north and the opposite one in the south, drawn to the centre and made one. The solid lies to both sides of the
  // edge; cutting it there would leave two edges between the same two vertices, so it is the dents that come apart.
  TriMesh sphere = test::icosphere(2);
  const auto opposite = [&](std::int32_t v) {
    Eigen::Index farthest = 0;
    (sphere.vertices * sphere.vertices.row(v).transpose()).minCoeff(&farthest);
    return static_cast<std::int32_t>(farthest);
  };
  const std::int32_t a = sphere.faces(0, 0);
  const std::int32_t b = sphere.faces(0, 1);
  const std::int32_t opposite_a = opposite(a);
  const std::int32_t opposite_b = opposite(b);
  const Eigen::RowVector3d half = 0.5 * (sphere.vertices.row(a) - sphere.vertices.row(b));
  sphere.vertices.row(a) = half;
  sphere.vertices.row(b) = -half;
  for (Eigen::Index i = 0; i < sphere.faces.size(); ++i) {
    std::int32_t& v = sphere.faces.data()[i];
    if (v == opposite_a) v = b;
    if (v == opposite_b) v = a;
  }
  const PolygonMesh mesh = test::polygons(sphere);
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.vertex_count(), 162);
  EXPECT_EQ(surface.report, (RepairReport{.dropped_vertices = 2, .split_vertices = 2}));
}

TEST(Glue, AnEdgeTwiceIsRefused) {
  // Two triangles glued along two sides, the third sides left open: the open sides have the same two vertices.
  const PolygonMesh mesh = test::polygons(test::tetrahedron().vertices, {{0, 1, 2}, {1, 0, 2}});
  Draft draft(mesh);
  draft.add_face({0, 1, 2}, 0);
  draft.add_face({1, 0, 2}, 1);
  draft.glue(1, 5, false, false);
  draft.glue(2, 4, false, false);
  number_vertices_without_double_edges(draft);
  const OffendingElements elements = expect_refusal(ErrorCode::non_manifold, [&] { refuse_double_edges(draft); });
  ASSERT_EQ(elements.edges.size(), 1U);
  EXPECT_EQ(elements.edges[0], (std::array<std::int32_t, 2>{0, 1}));
  draft.glue(0, 3, false, false);
  number_vertices_without_double_edges(draft);
  EXPECT_NO_THROW(refuse_double_edges(draft));
}

TEST(Glue, ManyFacesAtOneEdgeAreCutOpen) {
  // A book of eighty pages beside a sphere: none of its pages survives, and nothing takes long.
  const TriMesh sphere = test::icosphere(2);
  TriMesh book;
  book.vertices.resize(82, 3);
  book.faces.resize(80, 3);
  book.vertices.row(0) << 3, 0, 0;
  book.vertices.row(1) << 3, 0, 0.1;
  for (int page = 0; page < 80; ++page) {
    book.vertices.row(page + 2) << 3 + 0.1 * std::cos(0.07 * page), 0.1 * std::sin(0.07 * page), 0.05;
    book.faces.row(page) << 0, 1, page + 2;
  }
  const PolygonMesh mesh = test::polygons(test::joined(sphere, book));
  const Surface surface = repair(mesh, RepairMode::fill);
  expect_invariants(surface, mesh);
  EXPECT_EQ(surface.mesh.faces, sphere.faces);
  EXPECT_EQ(surface.report.dropped_components, 80);
}

}  // namespace
}  // namespace spherematch
