#include "samples/rotation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spherematch::samples {
namespace {

TEST(SamplesRotation, TurnsByTheWantedAngle) {
  for (int degrees = -120; degrees <= 120; degrees += 5) {
    const Quaternion q = turn({0, 0, 2}, degrees);
    EXPECT_NEAR(dot(q, q), 1, 1e-15);
    const Vec3 p = RigidMotion{q, {}}({1, 0, 0});
    EXPECT_NEAR(std::atan2(p.y, p.x) * 180 / 3.14159265358979, degrees, 0.3);
    EXPECT_NEAR(p.z, 0, 1e-15);
  }
}

TEST(SamplesRotation, MotionsComposeRightToLeft) {
  const RigidMotion a{turn({1, 2, 3}, 70), {4, 5, 6}}, b{turn({0, 1, 0}, -40), {-1, 0, 2}};
  const Vec3 p{0.3, -2, 7};
  EXPECT_NEAR(distance((a * b)(p), a(b(p))), 0, 1e-14);
}

TEST(SamplesRotation, DualQuaternionKeepsTheMotion) {
  const RigidMotion m{turn({1, -1, 0.5}, 100), {10, -20, 30}};
  DualQuaternion d(m);
  d.real = 3 * d.real;
  d.dual = 3 * d.dual;
  const Vec3 p{1, 2, 3};
  EXPECT_NEAR(distance(d.motion()(p), m(p)), 0, 1e-13);
}

}  // namespace
}  // namespace spherematch::samples
