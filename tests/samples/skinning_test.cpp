#include "samples/skinning.h"

#include <gtest/gtest.h>

namespace spherematch::samples {
namespace {

/// A rod of two bones from z = -20 to z = 20 with the joint at the origin.
Flesh rod() {
  const std::vector<BoneRow> rows{{"root", "", {0, 0, -20}, 1, 1}, {"tip", "root", {0, 0, 0}, 4, 1}};
  return {Skeleton(rows), {{1, false, {{"root", 1, {{0, 0, -20}, 2, {0, 0, 0}, 2}}, {"tip", 1, {{0, 0, 0}, 2, {0, 0, 20}, 2}}}}}};
}

TEST(SamplesSkinning, NothingMovesWithoutTurns) {
  const std::vector<Vec3> rest{{1, 2, 3}, {0, 2, -9}};
  const std::vector<Vec3> result = posed(rod(), {}, rest);
  for (std::size_t i = 0; i < rest.size(); ++i) EXPECT_NEAR(distance(result[i], rest[i]), 0, 1e-13);
}

TEST(SamplesSkinning, FarFromTheJointSkinMovesRigidlyAndAtItHalfway) {
  const std::vector<Turn> turns{{"tip", {1, 0, 0}, 90}};
  const std::vector<Vec3> result = posed(rod(), turns, {{2, 0, -15}, {2, 0, 15}, {2, 0, 0}, {0, 2, 0}});
  EXPECT_NEAR(distance(result[0], {2, 0, -15}), 0, 1e-9);
  EXPECT_NEAR(distance(result[1], {2, -15, 0}), 0, 0.1);
  EXPECT_NEAR(distance(result[2], {2, 0, 0}), 0, 1e-9);
  EXPECT_NEAR(result[3].y, result[3].z, 0.02) << "turned by 45 degrees";
}

TEST(SamplesSkinning, OneRestPointHasOnePlace) {
  const std::vector<Turn> turns{{"tip", {1, 1, 0}, 60}};
  const Vec3 p{1.3, 1.5, 0.7};
  EXPECT_EQ(posed(rod(), turns, {p})[0], posed(rod(), turns, {{0, 0, 0}, p})[1]);
}

}  // namespace
}  // namespace spherematch::samples
