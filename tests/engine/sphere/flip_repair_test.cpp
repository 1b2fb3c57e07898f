#include "engine/sphere/flip_repair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/sphere/orientation.h"
#include "tests/engine/sphere/spheres.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

using test::icosphere;
using test::Random;

/// Moves every vertex that `chosen` accepts by up to `size`.
template <typename Chosen>
Points shaken(const Points& sphere, double size, std::uint64_t seed, const Chosen& chosen) {
  Random random(seed);
  Points result = sphere;
  for (Eigen::Index v = 0; v < sphere.rows(); ++v) {
    const Eigen::RowVector3d move = size * random.uniform() * random.unit_vector().transpose();
    if (chosen(sphere.row(v))) result.row(v) = (sphere.row(v) + move).normalized();
  }
  return result;
}

TEST(FlipRepair, LeavesWellShapedSpheresAsTheyAre) {
  for (const TriMesh& mesh : {test::octahedron(), icosphere(0), icosphere(4)}) {
    const Points before = test::rotated(mesh.vertices, Random(1).rotation()).rowwise().normalized();
    Points sphere = before;
    EXPECT_TRUE(FlipRepair(mesh).repair(sphere));
    EXPECT_TRUE(sphere == before);
  }
}

TEST(FlipRepair, MendsAShakenSphere) {
  // The edges of icosphere(4) are 0.07 long.
  const TriMesh mesh = icosphere(4);
  const FlipRepair repair(mesh);
  for (const std::uint64_t seed : {1, 2, 3}) {
    Points sphere = shaken(mesh.vertices, 0.07, seed, [](const Eigen::RowVector3d&) { return true; });
    ASSERT_GT(flipped_faces(sphere, mesh.faces).size(), 150U);
    const Points before = sphere;
    EXPECT_TRUE(repair.repair(sphere));
    EXPECT_TRUE(flipped_faces(sphere, mesh.faces).empty());
    EXPECT_NEAR(total_solid_angle(sphere, mesh.faces), 4 * std::numbers::pi, 1e-12);
    EXPECT_LT((sphere.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
    // It mends, it does not start anew: no vertex goes further than an edge. Measured: 0.034.
    EXPECT_LT((sphere - before).rowwise().norm().maxCoeff(), 0.07);
  }
}

TEST(FlipRepair, TouchesOnlyTheSurroundingsOfFlips) {
  const TriMesh mesh = icosphere(4);
  const Points before = shaken(mesh.vertices, 0.06, 4, [](const Eigen::RowVector3d& p) { return p[2] > 0.8; });
  ASSERT_GT(flipped_faces(before, mesh.faces).size(), 5U);
  Points sphere = before;
  EXPECT_TRUE(FlipRepair(mesh).repair(sphere));
  EXPECT_TRUE(flipped_faces(sphere, mesh.faces).empty());
  int untouched = 0;
  for (Eigen::Index v = 0; v < sphere.rows(); ++v) {
    if (mesh.vertices(v, 2) > 0.5) continue;
    ASSERT_TRUE(sphere.row(v) == before.row(v)) << "vertex " << v;
    ++untouched;
  }
  EXPECT_GT(untouched, 1500);
}

TEST(FlipRepair, IsDeterministicAndSaysWhetherItSucceeded) {
  for (const double size : {0.1, 0.3, 1.0}) {
    const TriMesh mesh = icosphere(2);
    const FlipRepair repair(mesh);
    Points first = shaken(mesh.vertices, size, 5, [](const Eigen::RowVector3d&) { return true; }), second = first;
    const bool success = repair.repair(first);
    EXPECT_EQ(success, flipped_faces(first, mesh.faces).empty()) << size;
    EXPECT_EQ(repair.repair(second), success);
    EXPECT_TRUE(first == second);
    ASSERT_TRUE(first.allFinite());
  }
  // Vertices that all coincide leave nothing to widen.
  Points point = Points::Zero(12, 3);
  point.col(2).setOnes();
  EXPECT_FALSE(FlipRepair(icosphere(0)).repair(point));
  EXPECT_TRUE(point.allFinite());
}

TEST(FlipRepair, OpensCoincidentVertices) {
  TriMesh mesh = icosphere(3);
  mesh.vertices.row(mesh.faces(100, 1)) = mesh.vertices.row(mesh.faces(100, 0));
  ASSERT_FALSE(flipped_faces(mesh.vertices, mesh.faces).empty());
  EXPECT_TRUE(FlipRepair(mesh).repair(mesh.vertices));
  EXPECT_TRUE(flipped_faces(mesh.vertices, mesh.faces).empty());
}

}  // namespace
}  // namespace spherematch
