#include "engine/sphere/icosphere.h"

#include <gtest/gtest.h>

#include <numbers>

#include "engine/sphere/orientation.h"

namespace spherematch {
namespace {

TEST(Icosphere, CoversTheSphereOnce) {
  for (const int subdivisions : {0, 1, 4}) {
    const TriMesh mesh = icosphere(subdivisions);
    EXPECT_EQ(mesh.vertex_count(), 10 * (1 << (2 * subdivisions)) + 2);
    EXPECT_EQ(mesh.faces.rows(), 20 * (1 << (2 * subdivisions)));
    EXPECT_LT((mesh.vertices.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
    EXPECT_TRUE(flipped_faces(mesh.vertices, mesh.faces).empty());
    EXPECT_NEAR(total_solid_angle(mesh.vertices, mesh.faces), 4 * std::numbers::pi, 1e-11);
  }
}

TEST(Icosphere, KeepsTheNodesOfCoarserOnesInFront) {
  const TriMesh coarse = icosphere(2), fine = icosphere(3);
  EXPECT_TRUE(fine.vertices.topRows(coarse.vertex_count()) == coarse.vertices);
}

}  // namespace
}  // namespace spherematch
