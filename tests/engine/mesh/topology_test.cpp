#include "engine/mesh/topology.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

TEST(Topology, VertexFacesAreThoseThatHaveTheVertexInOrder) {
  const TriMesh mesh = test::icosphere(2);
  const VertexFaces around = vertex_faces(mesh.faces, mesh.vertex_count());
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    std::vector<std::int32_t> expected;
    for (std::int32_t f = 0; f < mesh.face_count(); ++f)
      if ((mesh.faces.row(f).array() == v).any()) expected.push_back(f);
    EXPECT_EQ(std::vector<std::int32_t>(around.of(v).begin(), around.of(v).end()), expected);
  }
}

TEST(Topology, VertexWithoutFaceHasNone) {
  const TriMesh mesh = test::tetrahedron();
  const VertexFaces around = vertex_faces(mesh.faces, 6);
  EXPECT_EQ(around.of(3).size(), 3U);
  EXPECT_TRUE(around.of(4).empty());
  EXPECT_TRUE(around.of(5).empty());
}

TEST(Topology, NeighboursShareTheEdge) {
  for (const TriMesh& mesh : {test::icosphere(2), test::torus(7, 5), test::open_disk(4)}) {
    const Triangles neighbours = face_neighbours(mesh.faces);
    Eigen::Index boundary = 0;
    for (Eigen::Index f = 0; f < mesh.face_count(); ++f)
      for (int k = 0; k < 3; ++k) {
        const std::int32_t other = neighbours(f, k);
        if (other < 0) {
          ++boundary;
          continue;
        }
        int shared = 0;
        for (int j = 0; j < 3; ++j)
          if (mesh.faces(other, j) == mesh.faces(f, (k + 1) % 3) && mesh.faces(other, (j + 1) % 3) == mesh.faces(f, k) &&
              neighbours(other, j) == f)
            ++shared;
        EXPECT_EQ(shared, 1);
      }
    const bool closed = euler_characteristic(mesh.faces) != 1;
    EXPECT_EQ(boundary, closed ? 0 : 24);
  }
}

TEST(Topology, NeighboursRefuseNonManifoldEdges) {
  Triangles three(3, 3);
  three << 0, 1, 2, 1, 0, 3, 0, 1, 4;
  const OffendingElements elements = test::expect_refusal(ErrorCode::non_manifold, [&] { (void)face_neighbours(three); });
  ASSERT_EQ(elements.edges.size(), 1U);
  EXPECT_EQ(elements.edges[0], (std::array<std::int32_t, 2>{0, 1}));
  Triangles same_way(2, 3);
  same_way << 0, 1, 2, 0, 1, 3;
  test::expect_refusal(ErrorCode::non_manifold, [&] { (void)face_neighbours(same_way); });
}

TEST(Topology, EulerCharacteristicOfKnownSurfaces) {
  EXPECT_EQ(euler_characteristic(test::tetrahedron().faces), 2);
  EXPECT_EQ(euler_characteristic(test::icosphere(3).faces), 2);
  EXPECT_EQ(euler_characteristic(test::torus(6, 5).faces), 0);
  EXPECT_EQ(euler_characteristic(test::klein_bottle(8, 6).faces), 0);
  EXPECT_EQ(euler_characteristic(test::open_disk(3).faces), 1);
  EXPECT_EQ(euler_characteristic(test::joined(test::tetrahedron(), test::tetrahedron()).faces), 4);
  EXPECT_EQ(euler_characteristic(Triangles(0, 3)), 0);
}

}  // namespace
}  // namespace spherematch
