#include "engine/io/float_range.h"

#include <gtest/gtest.h>

#include <limits>

namespace spherematch {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool fits(double low, double high) {
  Points points(3, 3);
  points << low, 0, 0, high, 0, 0, nan, nan, nan;
  return fits_float(box_of(points));
}

TEST(FloatRange, FitsNearTheOriginOnly) {
  EXPECT_TRUE(fits(-1, 1));
  EXPECT_TRUE(fits(0, 1e30));
  EXPECT_TRUE(fits(10, 11));
  EXPECT_FALSE(fits(1000, 1001));
  EXPECT_FALSE(fits(-1001, -1000));
  EXPECT_FALSE(fits(0, 1e39));
  EXPECT_FALSE(fits(0, 1e-35));
  EXPECT_FALSE(fits(3, 3));
}

TEST(FloatRange, TheBoxLeavesOutWhatIsNoNumber) {
  Points points(3, 3);
  points << nan, 7, 7, 1, 2, 3, -1, 5, 3;
  EXPECT_EQ(box_of(points).low, Eigen::RowVector3d(-1, 2, 3));
  EXPECT_EQ(box_of(points).high, Eigen::RowVector3d(1, 5, 3));
  EXPECT_EQ(box_of(points).center(), Eigen::RowVector3d(0, 3.5, 3));
  EXPECT_EQ(box_of(points).radius(), 1.5);
  EXPECT_EQ(box_of(Points::Constant(2, 3, nan)).radius(), 0);
}

}  // namespace
}  // namespace spherematch
