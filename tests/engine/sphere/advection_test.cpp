#include "engine/sphere/advection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/engine/sphere/spheres.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

using test::Random;

constexpr double pi = std::numbers::pi;

TEST(GeodesicStep, FollowsGreatCircles) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p = random.unit_vector(), direction = p.cross(random.unit_vector()).normalized();
    const double length = random.uniform(0, 4);
    const Eigen::Vector3d q = geodesic_step(p, length * direction);
    EXPECT_NEAR(q.norm(), 1, 1e-15);
    EXPECT_LT((q - (std::cos(length) * p + std::sin(length) * direction)).norm(), 1e-15);
    EXPECT_LT((geodesic_step(p, pi / 2 * direction) - direction).norm(), 1e-15);
    // sin(2 pi) is 2e-16 in doubles, and |direction| is one up to rounding.
    EXPECT_LT((geodesic_step(p, pi * direction) + p).norm(), 2e-15);
    EXPECT_LT((geodesic_step(p, 2 * pi * direction) - p).norm(), 2e-15);
    EXPECT_TRUE(geodesic_step(p, Eigen::Vector3d::Zero()) == p);
    EXPECT_LT((geodesic_step(p, 1e-200 * direction) - p).norm(), 1e-15);
  }
}

TEST(TangentField, InterpolatesToSecondOrderEverywhereWithThePoles) {
  // The tangential part of a constant vector is smooth at the poles, though its components there are not.
  const Eigen::Vector3d constant(0.8, -0.5, 0.3);
  const auto exact = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return constant - constant.dot(p) * p + p.cross(test::smooth_gradient(p));
  };
  double previous = 0;
  for (const int resolution : {32, 64, 128}) {
    const TangentField field(test::sampled_field(resolution, exact));
    Random random(2);
    double worst = 0;
    const auto look = [&](const Eigen::Vector3d& p) {
      const Eigen::Vector3d v = field(p);
      EXPECT_NEAR(v.dot(p), 0, 1e-14);
      worst = std::max(worst, (v - exact(p)).norm());
    };
    for (int i = 0; i < 2000; ++i) look(random.unit_vector());
    for (const double pole : {1.0, -1.0}) {
      look({0, 0, pole});
      for (const double distance : {1e-16, 1e-12, 1e-8, 1e-4, 1e-2, 0.05})
        for (int i = 0; i < 20; ++i) {
          const double angle = random.uniform(0, 2 * pi);
          look(Eigen::Vector3d(distance * std::cos(angle), distance * std::sin(angle), pole).normalized());
        }
    }
    if (previous > 0) {
      EXPECT_LT(worst, previous / 3.5) << "resolution " << resolution;
    }
    previous = worst;
  }
  // Measured: 0.033, 0.0083, 0.0020.
  EXPECT_LT(previous, 4e-3);
}

TEST(TangentField, HasNoSeam) {
  const TangentField field(test::sampled_field(32, [](const Eigen::Vector3d& p) { return test::smooth_gradient(p); }));
  for (int j = 0; j <= 64; ++j) {
    const double colatitude = pi * j / 64;
    for (const double longitude : {0.0, pi / 32, pi, 1.9 * pi}) {
      const Eigen::Vector3d a = field(sphere_point(colatitude, longitude - 1e-12)), b = field(sphere_point(colatitude, longitude + 1e-12));
      EXPECT_LT((a - b).norm(), 1e-9) << colatitude << " " << longitude;
    }
  }
  for (const double pole : {1.0, -1.0}) {
    const Eigen::Vector3d a = field(Eigen::Vector3d(1e-13, 0, pole)), b = field(Eigen::Vector3d(-1e-13, 1e-13, pole));
    // Across a pole the bilinear cells meet with a jump of their own error. Measured: 0.0026.
    EXPECT_LT((a - b).norm(), 0.006);
  }
}

TEST(Advect, AlongARotationHasALocalErrorOfThirdOrder) {
  const Eigen::Vector3d omega = Eigen::Vector3d(0.4, -0.3, 0.8).normalized();
  const TangentField field(test::sampled_field(512, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return omega.cross(p); }));
  const Points start = test::icosphere(3).vertices;
  double previous = 0;
  for (const double step : {0.8, 0.4, 0.2}) {
    for (const double sign : {1.0, -1.0}) {
      Points moved = start;
      advect(moved, field, sign * step);
      const Points exact = test::rotated(start, Eigen::AngleAxisd(sign * step, omega).toRotationMatrix());
      const double worst = (moved - exact).rowwise().norm().maxCoeff();
      EXPECT_LT((moved.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
      // Measured: 0.065 of the step's cube.
      EXPECT_LT(worst, 0.1 * step * step * step);
      if (previous > 0 && sign > 0) {
        EXPECT_LT(worst, previous / 7);
      }
      if (sign < 0) previous = worst;
    }
  }
}

TEST(Advect, ManySmallStepsMakeARotation) {
  const Eigen::Vector3d omega = Eigen::Vector3d(-0.2, 0.9, 0.1).normalized();
  const TangentField field(test::sampled_field(256, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return omega.cross(p); }));
  const Points start = test::icosphere(2).vertices;
  Points moved = start;
  for (int i = 0; i < 100; ++i) advect(moved, field, 0.02);
  const Points exact = test::rotated(start, Eigen::AngleAxisd(2.0, omega).toRotationMatrix());
  // The field's interpolation adds up. Measured: 1e-4.
  EXPECT_LT((moved - exact).rowwise().norm().maxCoeff(), 2e-4);
}

TEST(Advect, AZeroFieldMovesNothing) {
  const TangentField field(TangentGrid{Grid::Zero(16, 16), Grid::Zero(16, 16)});
  const Points start = test::icosphere(2).vertices;
  Points moved = start;
  advect(moved, field, 1);
  EXPECT_LT((moved - start).cwiseAbs().maxCoeff(), 1e-15);
}

}  // namespace
}  // namespace spherematch
