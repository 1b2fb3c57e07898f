#include "engine/mesh/draft.h"

#include <gtest/gtest.h>

#include "engine/mesh/glue.h"
#include "engine/mesh/triangulate.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

/// Mates point at each other, and the vertices at their ends agree.
void expect_consistent(const Draft& draft) {
  for (HalfEdge h = 0; h < draft.half_edge_count(); ++h) {
    const HalfEdge other = draft.mate_of(h);
    if (other == no_half_edge) continue;
    ASSERT_EQ(draft.mate_of(other), h);
    const bool same = draft.same_way[static_cast<std::size_t>(h)] != 0;
    ASSERT_EQ(same, draft.same_way[static_cast<std::size_t>(other)] != 0);
    ASSERT_EQ(draft.start(h), same ? draft.start(other) : draft.end(other));
    ASSERT_EQ(draft.end(h), same ? draft.end(other) : draft.start(other));
  }
}

Draft glued(const PolygonMesh& mesh) {
  Draft draft(mesh);
  triangulate(draft, RepairMode::fill);
  glue_by_index(draft, RepairMode::fill);
  return draft;
}

TEST(Draft, TurningFacesKeepsItGlued) {
  const PolygonMesh mesh = test::polygons(test::icosphere(1));
  Draft draft = glued(mesh);
  for (const std::int32_t face : {0, 5, 6, 7, 5, 79}) {
    draft.turn_face(face);
    expect_consistent(draft);
  }
  EXPECT_EQ(draft.turned[5], 0);
  EXPECT_EQ(draft.turned[6], 1);
  const auto uploaded = mesh.face(6);
  EXPECT_EQ(draft.start(18), uploaded[0]);
  EXPECT_EQ(draft.start(19), uploaded[2]);
  EXPECT_EQ(draft.start(20), uploaded[1]);
}

TEST(Draft, KeepingFacesOpensTheRest) {
  const PolygonMesh mesh = test::polygons(test::icosphere(1));
  Draft draft = glued(mesh);
  std::vector<char> keep(static_cast<std::size_t>(draft.face_count()), 1);
  keep[0] = keep[33] = 0;
  draft.keep_faces(keep);
  ASSERT_EQ(draft.face_count(), 78);
  expect_consistent(draft);
  EXPECT_EQ(std::count(draft.mate.begin(), draft.mate.end(), no_half_edge), 6);
  EXPECT_EQ(draft.polygon[0], 1);
  EXPECT_EQ(draft.polygon[77], 79);
}

TEST(Draft, ClassesFollowTheGluing) {
  const PolygonMesh mesh = test::polygons(test::tetrahedron());
  Draft draft = glued(mesh);
  number_vertices(draft);
  EXPECT_EQ(draft.vertex, draft.corner);
  EXPECT_EQ(draft.position.size(), 4U);
  // A face cut free of its neighbours has vertices of its own.
  for (HalfEdge h = 3; h < 6; ++h) draft.unglue(h);
  number_vertices(draft);
  EXPECT_EQ(draft.position.size(), 7U);
  EXPECT_EQ(draft.report.split_vertices, 3);
  EXPECT_EQ(draft.report.welded_vertices, 0);
}

TEST(Draft, OffendersListsAtMostTwenty) {
  Offenders offenders;
  for (std::int32_t i = 0; i < 50; ++i) {
    offenders.add_vertex(i);
    offenders.add_face(i / 2);
    offenders.add_edge(i + 1, i);
  }
  EXPECT_EQ(offenders.elements().vertices.size(), 20U);
  EXPECT_EQ(offenders.elements().edges.size(), 20U);
  EXPECT_EQ(offenders.elements().edges[3], (std::array<std::int32_t, 2>{3, 4}));
  ASSERT_EQ(offenders.elements().faces.size(), 20U);
  EXPECT_EQ(offenders.elements().faces[19], 19);
}

}  // namespace
}  // namespace spherematch
