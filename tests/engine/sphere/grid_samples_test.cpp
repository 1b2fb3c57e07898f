#include "engine/sphere/grid_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/sphere/harmonics.h"
#include "tests/engine/sphere/spheres.h"

namespace spherematch {
namespace {

double largest_error(int resolution) {
  const GridSamples samples({test::sampled(resolution, test::smooth_function)});
  test::Random random(1);
  Points points(2000, 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) points.row(i) = random.unit_vector();
  points.row(0) << 0, 0, 1;  // the poles, and both sides of the seam
  points.row(1) << 0, 0, -1;
  points.row(2) << 1, 0, 0;
  points.row(3) << std::cos(1e-9), -std::sin(1e-9), 0;
  double error = 0;
  samples.for_each_stencil(points, [&](Eigen::Index i, const GridSamples::Stencil& stencil) {
    error = std::max(error, std::abs(samples(stencil, 0)[0] - test::smooth_function(points.row(i))));
  });
  return error;
}

TEST(GridSamples, AreOfThirdOrderEverywhere) {
  const double coarse = largest_error(32), fine = largest_error(64);
  EXPECT_GT(coarse, 0);
  EXPECT_LT(fine, coarse / 6);  // 8 in the limit
  EXPECT_LT(largest_error(128), fine / 6);
}

TEST(GridSamples, KeepTheirChannelsApartAndMeetTheGridAtItsNodes) {
  constexpr int n = 16;
  std::vector<Grid> grids;
  test::Random random(2);
  for (int c = 0; c < 10; ++c) {
    grids.emplace_back(n, n);
    for (Eigen::Index i = 0; i < grids.back().size(); ++i) grids.back().data()[i] = random.uniform(-1, 1);
  }
  const GridSamples samples(grids);
  ASSERT_EQ(samples.channels(), 10U);
  ASSERT_EQ(samples.packs(), 2U);
  samples.for_each_stencil(cell_centers(n), [&](Eigen::Index node, const GridSamples::Stencil& stencil) {
    for (std::size_t c = 0; c < grids.size(); ++c) {
      constexpr auto kPack = static_cast<std::size_t>(GridSamples::pack_size);
      EXPECT_NEAR(samples(stencil, c / kPack)[static_cast<Eigen::Index>(c % kPack)], grids[c].data()[node], 1e-6);
    }
    const std::vector<Eigen::Index> wanted{9, 2, 3, 8, 8};
    samples.for_each_value(stencil, wanted, [&](std::size_t c, float value) {
      EXPECT_NEAR(value, grids[static_cast<std::size_t>(wanted[c])].data()[node], 1e-6);
    });
  });
}

}  // namespace
}  // namespace spherematch
