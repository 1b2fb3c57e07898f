// The meshes at rest, made anew: what the ground truth stands on.
#include <gtest/gtest.h>

#include "samples/sample_set.h"
#include "samples/skinning.h"
#include "tests/samples/meshes.h"

namespace spherematch::samples {
namespace {

class SamplesRestMeshes : public testing::TestWithParam<Creature (*)()> {};

void expect_good_sphere(const Flesh& flesh, const Mesh& mesh) {
  EXPECT_NO_THROW(SurfaceMesh{mesh});
  EXPECT_EQ(static_cast<long>(mesh.vertices.size()) - static_cast<long>(mesh.triangles.size()) / 2, 2);
  const std::vector<double> angles = smallest_angles(mesh);
  EXPECT_EQ(share_below(angles, 15), 0);
  EXPECT_LT(share_below(angles, 30), 0.01);
  for (const Vec3& p : mesh.vertices) ASSERT_LT(std::abs(flesh.sample(p).value), 1e-3);
}

TEST_P(SamplesRestMeshes, ShareMirroredLandmarksExactly) {
  const Creature creature = GetParam()();
  const RestMeshes rest = rest_meshes(creature);
  expect_good_sphere(creature.flesh, rest.shared.mesh);
  expect_good_sphere(creature.flesh, rest.independent.mesh);
  EXPECT_NE(rest.shared.mesh.vertices.size(), rest.independent.mesh.vertices.size());

  const Landmarks& landmarks = rest.landmarks;
  ASSERT_GE(landmarks.points.size(), 500u);
  ASSERT_EQ(rest.shared.pinned.size(), landmarks.points.size());
  ASSERT_EQ(rest.independent.pinned.size(), landmarks.points.size());
  for (std::size_t i = 0; i < landmarks.points.size(); ++i) {
    const Vec3& p = landmarks.points[i];
    const auto m = static_cast<std::size_t>(landmarks.mirror[i]);
    EXPECT_EQ(landmarks.points[m], mirrored(p));
    EXPECT_EQ(static_cast<std::size_t>(landmarks.mirror[m]), i);
    for (const PinnedMesh* mesh : {&rest.shared, &rest.independent}) {
      EXPECT_EQ(mesh->mesh.vertices[static_cast<std::size_t>(mesh->pinned[i])], p);
      EXPECT_EQ(mesh->mesh.vertices[static_cast<std::size_t>(mesh->pinned[m])], mirrored(p));
    }
  }

  for (const Pose& pose : creature.poses) {
    const std::vector<Vec3> shared = posed(creature.flesh, pose.turns, rest.shared.mesh.vertices);
    const std::vector<Vec3> independent = posed(creature.flesh, pose.turns, rest.independent.mesh.vertices);
    for (std::size_t i = 0; i < landmarks.points.size(); ++i)
      ASSERT_EQ(shared[static_cast<std::size_t>(rest.shared.pinned[i])], independent[static_cast<std::size_t>(rest.independent.pinned[i])]);
  }
}

INSTANTIATE_TEST_SUITE_P(All, SamplesRestMeshes, testing::Values(&hound, &imp), [](const auto& info) { return info.param().name; });

}  // namespace
}  // namespace spherematch::samples
