#include "samples/landmarks.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/samples/meshes.h"

namespace spherematch::samples {
namespace {

Flesh unit_ball() {
  const std::vector<BoneRow> rows{{"ball", "", {0, 0, 0}, 1, 0.15}};
  return {Skeleton(rows), {{1, false, {{"ball", 1, {{0, 0, 0}, 1, {0, 0, 0}, 1}}}}}};
}

TEST(SamplesLandmarks, AreSymmetricEvenAndAvoidTheHoles) {
  const std::vector<Ball> avoided{{{0.6, 0.8, 0}, 0.3}};
  const Landmarks landmarks = spread_landmarks(unit_ball(), sphere_mesh(4), 60, avoided);
  ASSERT_GE(landmarks.points.size(), 60u);
  ASSERT_EQ(landmarks.mirror.size(), landmarks.points.size());
  int in_the_middle = 0;
  for (std::size_t i = 0; i < landmarks.points.size(); ++i) {
    const Vec3& p = landmarks.points[i];
    EXPECT_EQ(landmarks.points[static_cast<std::size_t>(landmarks.mirror[i])], mirrored(p));
    in_the_middle += p.x == 0 ? 1 : 0;
    EXPECT_NEAR(norm(p), 1, 1e-6);
    EXPECT_FALSE(is_in(avoided, p) || is_in(avoided, mirrored(p)));
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT(distance(p, landmarks.points[j]), 0.2);  // 60 even ones are about 0.45 apart
  }
  EXPECT_GT(in_the_middle, 3);
}

TEST(SamplesLandmarks, TooManyAreRefused) {
  EXPECT_THROW((void)spread_landmarks(unit_ball(), sphere_mesh(2), 1000, {}), std::invalid_argument);
}

}  // namespace
}  // namespace spherematch::samples
