#include "samples/flesh.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <stdexcept>

#include "samples/creature.h"

namespace spherematch::samples {
namespace {

/// Points in and around a creature, some of them in the middle plane.
std::vector<Vec3> points_around(const Flesh& flesh, int count) {
  const auto [low, high] = flesh.bounds();
  std::mt19937_64 random(7);
  const auto between = [&](double a, double b) { return a + (b - a) * static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const Vec3 p{between(low.x, high.x), between(low.y, high.y), between(low.z, high.z)};
    points.push_back(i % 10 == 0 ? Vec3{0, p.y, p.z} : p);
  }
  return points;
}

/// Those of them that are near the surface, moved onto it.
std::vector<Vec3> surface_points(const Flesh& flesh) {
  std::vector<Vec3> points;
  for (const Vec3& p : points_around(flesh, 8000))
    if (std::abs(flesh.sample(p).value) < 1) points.push_back(flesh.project(p));
  return points;
}

TEST(SamplesFlesh, DistanceToSpheresAndCones) {
  const RoundCone sphere{{1, 2, 3}, 2, {1, 2, 3}, 2};
  EXPECT_DOUBLE_EQ(signed_distance(sphere, {1, 2, 8}).value, 3);
  EXPECT_EQ(signed_distance(sphere, {1, 2, 8}).gradient, (Vec3{0, 0, 1}));
  EXPECT_DOUBLE_EQ(signed_distance(sphere, {1, 2, 3}).value, -2);

  const RoundCone rod{{0, 0, 0}, 1, {10, 0, 0}, 1};
  EXPECT_DOUBLE_EQ(signed_distance(rod, {5, 4, 0}).value, 3);
  EXPECT_DOUBLE_EQ(signed_distance(rod, {13, 4, 0}).value, 4);
}

TEST(SamplesFlesh, AConeIsTheUnionOfItsSpheres) {
  const RoundCone cone{{0, 0, 0}, 3, {8, 1, 0}, 1};
  for (const Vec3& p : {Vec3{4, 5, 1}, Vec3{-2, 3, 0}, Vec3{9, -2, 4}, Vec3{5, 1, 0}}) {
    double nearest = 1e9;
    for (int i = 0; i <= 10000; ++i) {
      const double t = i / 10000.0;
      nearest = std::min(nearest, distance(p, t * cone.b) - 3 + 2 * t);
    }
    EXPECT_NEAR(signed_distance(cone, p).value, nearest, 1e-6);
  }
}

TEST(SamplesFlesh, AFlattenedSphereIsAnEllipsoid) {
  const RoundCone flat{{0, 0, 0}, 2, {0, 0, 0}, 2, {0, 1, 0}, 0.5};
  EXPECT_NEAR(signed_distance(flat, {0, 1, 0}).value, 0, 1e-15);
  EXPECT_NEAR(signed_distance(flat, {2, 0, 0}).value, 0, 1e-15);
  EXPECT_NEAR(signed_distance(flat, {0, 1.5, 0}).value, 0.5, 1e-15);
}

TEST(SamplesFlesh, SmoothMinimum) {
  const Sample near{1, {1, 0, 0}}, far{4, {0, 1, 0}};
  EXPECT_EQ(smooth_minimum(near, far, 2).value, 1);
  EXPECT_EQ(smooth_minimum(near, far, 2).gradient, near.gradient);
  EXPECT_EQ(smooth_minimum(near, near, 2).value, 0.5);
  EXPECT_EQ(smooth_minimum(near, far, 10).value, smooth_minimum(far, near, 10).value);
  EXPECT_LT(smooth_minimum(near, far, 10).value, 1);
}

TEST(SamplesFlesh, UnknownBonesAreRefused) {
  const std::vector<BoneRow> rows{{"trunk", "", {0, 0, 0}, 1, 1}, {"head", "trunk", {0, 1, 0}, 1, 1}};
  const RoundCone ball{{0, 0, 0}, 1, {0, 0, 0}, 1};
  EXPECT_THROW(Flesh(Skeleton(rows), {{1, false, {{"trunk", 1, ball}, {"arm", 1, ball}}}}), std::invalid_argument);
  EXPECT_THROW(Flesh(Skeleton(rows), {{1, false, {{"trunk", 1, ball}}}}), std::invalid_argument) << "a head without flesh";
}

class SamplesCreature : public testing::TestWithParam<Creature (*)()> {
 protected:
  const Creature creature_ = GetParam()();
  const Flesh& flesh_ = creature_.flesh;
};

TEST_P(SamplesCreature, IsExactlySymmetric) {
  for (const Vec3& p : points_around(flesh_, 5000)) ASSERT_EQ(flesh_.sample(p).value, flesh_.sample(mirrored(p)).value);
}

TEST_P(SamplesCreature, ProjectionEndsOnTheSurface) {
  const std::vector<Vec3> points = surface_points(flesh_);
  ASSERT_GT(points.size(), 200u);
  for (const Vec3& p : points) EXPECT_LT(std::abs(flesh_.sample(p).value), 1e-3);
}

TEST_P(SamplesCreature, TheMiddlePlaneIsProjectedIntoItself) {
  int seen = 0;
  for (const Vec3& p : points_around(flesh_, 5000)) {
    if (p.x != 0 || std::abs(flesh_.sample(p).value) > 2) continue;
    EXPECT_EQ(flesh_.project(p).x, 0);
    ++seen;
  }
  EXPECT_GT(seen, 20);
}

TEST_P(SamplesCreature, GradientIsThatOfTheValue) {
  const double h = 1e-5;
  for (const Vec3& p : surface_points(flesh_)) {
    const auto slope = [&](const Vec3& step) { return (flesh_.sample(p + step).value - flesh_.sample(p - step).value) / (2 * h); };
    const Vec3 differences{slope({h, 0, 0}), slope({0, h, 0}), slope({0, 0, h})};
    const Vec3 gradient = flesh_.sample(p).gradient;
    EXPECT_GT(dot(differences, gradient), 0.95 * norm(differences) * norm(gradient)) << p.x << ' ' << p.y << ' ' << p.z;
  }
}

TEST_P(SamplesCreature, WeightsAreAPartitionAndSymmetric) {
  const std::vector<Bone>& bones = flesh_.skeleton().bones();
  for (const Vec3& p : surface_points(flesh_)) {
    const std::vector<double> here = flesh_.weights(p), there = flesh_.weights(mirrored(p));
    EXPECT_NEAR(std::accumulate(here.begin(), here.end(), 0.0), 1, 1e-12);
    for (std::size_t b = 0; b < bones.size(); ++b) {
      EXPECT_GE(here[b], 0);
      EXPECT_NEAR(here[b], there[static_cast<std::size_t>(bones[b].mirror)], 1e-12);
    }
  }
}

TEST_P(SamplesCreature, WeightsAreContinuous) {
  for (const Vec3& p : surface_points(flesh_)) {
    const std::vector<double> here = flesh_.weights(p), near = flesh_.weights(p + Vec3{1e-4, -1e-4, 1e-4});
    for (std::size_t b = 0; b < here.size(); ++b) EXPECT_NEAR(here[b], near[b], 1e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(All, SamplesCreature, testing::Values(&hound, &imp), [](const auto& info) { return info.param().name; });

}  // namespace
}  // namespace spherematch::samples
