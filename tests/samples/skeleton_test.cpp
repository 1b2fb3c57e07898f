#include "samples/skeleton.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace spherematch::samples {
namespace {

const std::vector<BoneRow> rows{{"trunk", "", {0, 1, 0}, 1, 1}, {"arm", "trunk", {1, 2, 0}, 1, 1}, {"hand", "arm", {3, 2, 0}, 1, 1}};

Vec3 moved(const Skeleton& skeleton, const std::vector<Turn>& turns, std::string_view bone, const Vec3& p) {
  return skeleton.motions(turns)[static_cast<std::size_t>(skeleton.find(bone))](p);
}

TEST(SamplesSkeleton, ABoneBesideTheMiddleIsTwo) {
  const Skeleton skeleton(rows);
  ASSERT_EQ(skeleton.bones().size(), 5u);
  const Bone &left = skeleton.bones()[3], &right = skeleton.bones()[4];
  EXPECT_EQ(left.name, "hand.l");
  EXPECT_EQ(right.name, "hand.r");
  EXPECT_EQ(left.mirror, 4);
  EXPECT_EQ(right.mirror, 3);
  EXPECT_EQ(right.pivot, mirrored(left.pivot));
  EXPECT_EQ(skeleton.bones()[static_cast<std::size_t>(right.parent)].name, "arm.r");
  EXPECT_EQ(skeleton.bones()[0].mirror, 0);
  EXPECT_EQ(skeleton.find("arm"), skeleton.find("arm.l"));
  EXPECT_THROW((void)skeleton.find("leg"), std::invalid_argument);
}

TEST(SamplesSkeleton, AJointStaysAndWhatIsBeyondFollows) {
  const Skeleton skeleton(rows);
  const std::vector<Turn> turns{{"arm.l", {0, 0, 1}, 90}};
  EXPECT_NEAR(distance(moved(skeleton, turns, "arm.l", {1, 2, 0}), {1, 2, 0}), 0, 1e-14);
  EXPECT_NEAR(distance(moved(skeleton, turns, "hand.l", {3, 2, 0}), {1, 4, 0}), 0, 0.02);
  EXPECT_EQ(moved(skeleton, turns, "hand.r", {-3, 2, 0}), (Vec3{-3, 2, 0}));
  EXPECT_EQ(moved(skeleton, turns, "trunk", {5, 5, 5}), (Vec3{5, 5, 5}));
}

TEST(SamplesSkeleton, TurnsOfOneJointApplyInTheirOrder) {
  const Skeleton skeleton(rows);
  const Vec3 p = moved(skeleton, {{"trunk", {0, 0, 1}, 90}, {"trunk", {1, 0, 0}, 90}}, "trunk", {1, 1, 0});
  EXPECT_NEAR(distance(p, {0, 1, 1}), 0, 0.02);
}

}  // namespace
}  // namespace spherematch::samples
