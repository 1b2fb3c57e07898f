#include "engine/register/wigner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/engine/sphere/spheres.h"

namespace spherematch {
namespace {

using test::Random;
using test::random_harmonics;

constexpr double pi = std::numbers::pi;

TEST(WignerD, HasTheClosedFormsOfLowDegrees) {
  for (const double beta : {0.0, 0.3, 1.7, pi}) {
    const std::vector<Eigen::MatrixXd> d = wigner_d(2, beta);
    ASSERT_EQ(d.size(), 3U);
    const double c = std::cos(beta), s = std::sin(beta), r = std::sqrt(0.5);
    EXPECT_NEAR(d[0](0, 0), 1, 1e-15);
    Eigen::Matrix3d one;  // rows m, columns n from -1 to 1
    one << (1 + c) / 2, s * r, (1 - c) / 2, -s * r, c, s * r, (1 - c) / 2, -s * r, (1 + c) / 2;
    EXPECT_LT((d[1] - one).cwiseAbs().maxCoeff(), 1e-15) << "beta " << beta;
    EXPECT_NEAR(d[2](4, 4), (1 + c) * (1 + c) / 4, 1e-15);
    EXPECT_NEAR(d[2](4, 2), std::sqrt(6.0) / 4 * s * s, 1e-15);
    EXPECT_NEAR(d[2](3, 2), -std::sqrt(1.5) * s * c, 2e-15);
    EXPECT_NEAR(d[2](2, 2), (3 * c * c - 1) / 2, 1e-15);
  }
}

TEST(WignerD, IsOrthogonalUpToHighDegrees) {
  for (const double beta : {1e-7, 0.01, 0.8, pi / 2, 3.0, pi - 1e-7}) {
    const std::vector<Eigen::MatrixXd> d = wigner_d(63, beta);
    double worst = 0;
    for (const Eigen::MatrixXd& matrix : d)
      worst =
          std::max(worst, (matrix * matrix.transpose() - Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols())).cwiseAbs().maxCoeff());
    // Measured: 1.5e-13.
    EXPECT_LT(worst, 1e-12) << "beta " << beta;
  }
}

TEST(FullCoefficients, HaveTheSymmetryOfRealFunctions) {
  const Harmonics a = random_harmonics(5, 1);
  const std::vector<DegreeVector> full = full_coefficients(5, a);
  ASSERT_EQ(full.size(), 6U);
  double norm = 0;
  for (int l = 0; l <= 5; ++l) {
    const DegreeVector& f = full[static_cast<std::size_t>(l)];
    ASSERT_EQ(f.size(), 2 * l + 1);
    for (int m = 0; m <= l; ++m) {
      EXPECT_EQ(f[l + m], a[harmonic_index(5, l, m)]);
      EXPECT_EQ(f[l - m], (m % 2 == 0 ? 1.0 : -1.0) * std::conj(f[l + m]));
    }
    norm += f.squaredNorm();
  }
  EXPECT_NEAR(norm, harmonic_dot(5, a, a), 1e-13 * norm);
}

std::vector<Eigen::Matrix3d> rotations() {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  std::vector<Eigen::Matrix3d> result{Eigen::Matrix3d::Identity()};
  for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1), Vector3d(1, 1, 0).normalized()})
    for (const double angle : {pi, pi / 2, -0.7, 1e-9}) result.push_back(AngleAxisd(angle, axis).toRotationMatrix());
  Random random(2);
  for (int i = 0; i < 10; ++i) result.push_back(random.rotation());
  return result;
}

TEST(RotateCoefficients, AgreesWithResamplingTheRotatedFunction) {
  constexpr int degree = 7, resolution = 16;
  const HarmonicTransform transform(resolution, degree);
  const Harmonics f = random_harmonics(degree, 3);
  for (const Eigen::Matrix3d& rotation : rotations()) {
    const Eigen::Matrix3d back = rotation.transpose();
    const Grid resampled = test::sampled(resolution, [&](const Eigen::Vector3d& p) { return test::exact_sum(degree, f, back * p); });
    const std::vector<DegreeVector> exact = full_coefficients(degree, transform.analyze(resampled));
    const std::vector<DegreeVector> rotated = CoefficientRotation(degree, rotation)(full_coefficients(degree, f));
    for (std::size_t l = 0; l <= degree; ++l)
      // Measured: 4e-15.
      EXPECT_LT((rotated[l] - exact[l]).cwiseAbs().maxCoeff(), 5e-14) << "l " << l << "\n" << rotation;
  }
}

TEST(RotateCoefficients, ComposesAndKeepsNorms) {
  const auto turned = [](const std::vector<DegreeVector>& coefficients, const Eigen::Matrix3d& rotation) {
    return CoefficientRotation(static_cast<int>(coefficients.size()) - 1, rotation)(coefficients);
  };
  constexpr int degree = 31;
  const std::vector<DegreeVector> f = full_coefficients(degree, random_harmonics(degree, 4));
  const std::vector<Eigen::Matrix3d> all = rotations();
  double worst = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Eigen::Matrix3d first = all[i], second = all[(7 * i + 3) % all.size()];
    const std::vector<DegreeVector> twice = turned(turned(f, first), second);
    const std::vector<DegreeVector> once = turned(f, second * first);
    for (std::size_t l = 0; l <= degree; ++l) {
      worst = std::max(worst, (twice[l] - once[l]).cwiseAbs().maxCoeff());
      EXPECT_NEAR(twice[l].norm(), f[l].norm(), 1e-13 * f[l].norm());
    }
  }
  // Measured: 3e-14.
  EXPECT_LT(worst, 5e-13);
}

}  // namespace
}  // namespace spherematch
