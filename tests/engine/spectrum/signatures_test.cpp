#include "engine/spectrum/signatures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/engine/sphere/spheres.h"

namespace spherematch {
namespace {

constexpr double pi = std::numbers::pi;

/// The exact eigenpairs of the sphere of unit area up to a degree, at a few points.
struct SphereBasis {
  Eigen::VectorXd values;
  Eigen::MatrixXf vectors;
};

SphereBasis sphere_basis(int degree, Eigen::Index points) {
  const Eigen::Index count = (degree + 1) * (degree + 1);
  SphereBasis basis{Eigen::VectorXd(count), Eigen::MatrixXf(points, count)};
  test::Random random(1);
  for (Eigen::Index p = 0; p < points; ++p) {
    const Eigen::Vector3d x = random.unit_vector();
    Eigen::Index column = 0;
    for (int l = 0; l <= degree; ++l)
      for (int m = -l; m <= l; ++m, ++column) {
        basis.values[column] = 4 * pi * l * (l + 1);
        const std::complex<double> y = std::sqrt(4 * pi) * test::exact_harmonic(l, std::abs(m), x);
        basis.vectors(p, column) = static_cast<float>(m == 0 ? y.real() : std::sqrt(2.0) * (m > 0 ? y.real() : y.imag()));
      }
  }
  return basis;
}

TEST(HeatKernelSignatures, OfTheSphereAreTheirKnownConstants) {
  const SphereBasis basis = sphere_basis(13, 50);
  const Eigen::MatrixXd signatures = heat_kernel_signatures(basis.values, basis.vectors, {0.01, 1.0 / 16, 1.0 / 8, 1.0});
  ASSERT_EQ(signatures.rows(), 50);
  ASSERT_EQ(signatures.cols(), 4);
  // The constants have six digits, the vectors are floats.
  for (Eigen::Index p = 0; p < 50; ++p) {
    EXPECT_NEAR(signatures(p, 0), 8.29967, 1e-5);
    EXPECT_NEAR(signatures(p, 1), 1.66912, 1e-5);
    EXPECT_NEAR(signatures(p, 2), 1.13005, 1e-5);
    EXPECT_NEAR(signatures(p, 3), 1, 1e-6);
  }
}

TEST(HeatKernelSignatures, AreTheSumOverThePairs) {
  Eigen::VectorXd values(3);
  values << 0, 2, 5;
  Eigen::MatrixXf vectors(2, 3);
  vectors << 1, -2, 0.5F, 1, 3, -0.25F;
  const Eigen::MatrixXd signatures = heat_kernel_signatures(values, vectors, {0.5, 2});
  EXPECT_DOUBLE_EQ(signatures(0, 0), 1 + 4 * std::exp(-1.0) + 0.25 * std::exp(-2.5));
  EXPECT_DOUBLE_EQ(signatures(1, 1), 1 + 9 * std::exp(-4.0) + 0.0625 * std::exp(-10.0));
  Eigen::MatrixXf negated = vectors;
  negated.col(1) *= -1;
  EXPECT_TRUE(heat_kernel_signatures(values, negated, {0.5, 2}) == signatures) << "the sign of a vector is arbitrary";
}

TEST(WaveKernelSignatures, OfTheSphereAreOne) {
  // The weights sum to one and are equal within a degree, where the squares of the vectors add up to 2 l + 1.
  const SphereBasis basis = sphere_basis(9, 50);
  const Eigen::MatrixXd signatures = wave_kernel_signatures(basis.values, basis.vectors, 16);
  ASSERT_EQ(signatures.rows(), 50);
  ASSERT_EQ(signatures.cols(), 16);
  EXPECT_LT((signatures.array() - 1).abs().maxCoeff(), 1e-6);
}

TEST(WaveKernelSignatures, AreFiniteForASmallBasis) {
  Eigen::VectorXd values(4);
  values << -1e-12, 1, 1, 7;
  const Eigen::MatrixXd signatures = wave_kernel_signatures(values, Eigen::MatrixXf::Random(6, 4), 16);
  EXPECT_TRUE(signatures.allFinite());
  EXPECT_GE(signatures.minCoeff(), 0);
}

}  // namespace
}  // namespace spherematch
