#include "engine/sphere/harmonics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include "tests/engine/sphere/spheres.h"

namespace spherematch {
namespace {

using test::exact_harmonic;
using test::random_harmonics;
using test::sampled;
using test::sampled_field;

constexpr double pi = std::numbers::pi;

double largest(const Harmonics& a) { return a.cwiseAbs().maxCoeff(); }

TEST(HarmonicTransform, AnalysisUndoesSynthesisUpToTheDocumentedDegree) {
  for (const int resolution : {8, 15, 16, 64, 128, 256}) {
    const HarmonicTransform transform(resolution, (resolution - 1) / 2);
    ASSERT_EQ(transform.resolution(), resolution);
    ASSERT_EQ(transform.degree(), (resolution - 1) / 2);
    Harmonics coefficients = random_harmonics(transform.degree(), 1);
    coefficients[0] = 0.5;
    // Measured: 7e-14, at the highest resolution.
    EXPECT_LT(largest(transform.analyze(transform.synthesize(coefficients)) - coefficients), 2e-13) << "resolution " << resolution;
  }
}

TEST(HarmonicTransform, EveryBasisFunctionIsTheStandardOneAtTheCellCentres) {
  constexpr int degree = 7;
  const HarmonicTransform transform(16, degree);
  for (int m = 0; m <= degree; ++m)
    for (int l = m; l <= degree; ++l)
      for (const std::complex<double> unit : {std::complex<double>(1, 0), std::complex<double>(0, 1)}) {
        if (m == 0 && unit.imag() != 0) continue;
        Harmonics coefficients = Harmonics::Zero(harmonic_count(degree));
        coefficients[harmonic_index(degree, l, m)] = unit;
        const Grid exact =
            sampled(16, [&](const Eigen::Vector3d& p) { return (m == 0 ? 1 : 2) * (unit * exact_harmonic(l, m, p)).real(); });
        // Measured: 4e-15.
        EXPECT_LT((transform.synthesize(coefficients) - exact).abs().maxCoeff(), 5e-14) << "l " << l << " m " << m;
      }
}

TEST(HarmonicTransform, NormsAndProductsOfPolynomialsAreTheirIntegrals) {
  const HarmonicTransform transform(16, 7);
  const auto coefficients = [&](const auto& function) { return transform.analyze(sampled(16, function)); };
  const Harmonics one = coefficients([](const Eigen::Vector3d&) { return 1.0; });
  const Harmonics x = coefficients([](const Eigen::Vector3d& p) { return p[0]; });
  const Harmonics xy = coefficients([](const Eigen::Vector3d& p) { return p[0] * p[1]; });
  const Harmonics zz = coefficients([](const Eigen::Vector3d& p) { return p[2] * p[2]; });
  const Harmonics xxz = coefficients([](const Eigen::Vector3d& p) { return p[0] * p[0] * p[2]; });
  const Harmonics z = coefficients([](const Eigen::Vector3d& p) { return p[2]; });
  EXPECT_NEAR(one[0].real(), std::sqrt(4 * pi), 1e-13);
  EXPECT_NEAR(harmonic_dot(7, one, one), 4 * pi, 1e-12);
  EXPECT_NEAR(harmonic_dot(7, x, x), 4 * pi / 3, 1e-13);
  EXPECT_NEAR(harmonic_dot(7, xy, xy), 4 * pi / 15, 1e-13);
  EXPECT_NEAR(harmonic_dot(7, zz, zz), 4 * pi / 5, 1e-13);
  EXPECT_NEAR(harmonic_dot(7, one, zz), 4 * pi / 3, 1e-13);
  EXPECT_NEAR(harmonic_dot(7, z, xxz), 4 * pi / 15, 1e-13);
  EXPECT_NEAR(harmonic_dot(7, x, xy), 0, 1e-14);
}

TEST(HarmonicTransform, GradientAndTurnedGradientAreTheAnalyticOnes) {
  for (const int resolution : {16, 64}) {
    const HarmonicTransform transform(resolution, resolution / 2 - 1);
    const Harmonics f = transform.analyze(sampled(resolution, test::smooth_function)), none = Harmonics::Zero(f.size());
    const auto expect = [&](const TangentGrid& field, const auto& exact, const char* which) {
      const TangentGrid analytic = sampled_field(resolution, exact);
      // The gradient multiplies the rounding of degree l by l. Measured: 9e-13.
      EXPECT_LT((field.colatitude - analytic.colatitude).abs().maxCoeff(), 2e-12) << which;
      EXPECT_LT((field.longitude - analytic.longitude).abs().maxCoeff(), 2e-12) << which;
    };
    const auto turned = [](const Eigen::Vector3d& p) -> Eigen::Vector3d { return p.cross(test::smooth_gradient(p)); };
    expect(transform.synthesize_tangent(f, none), test::smooth_gradient, "gradient");
    expect(transform.synthesize_tangent(none, f), turned, "turned gradient");
    const auto both = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return 2 * test::smooth_gradient(p) - 3 * turned(p); };
    expect(transform.synthesize_tangent(2 * f, -3 * f), both, "both");
  }
}

TEST(HarmonicTransform, TangentialSynthesisAndItsTransposeAreAdjoint) {
  for (const int resolution : {16, 64}) {
    const int degree = resolution / 2 - 1;
    const HarmonicTransform transform(resolution, degree);
    const Harmonics gradient = random_harmonics(degree, 2), curl = random_harmonics(degree, 3);
    test::Random random(4);
    TangentGrid field{Grid(resolution, resolution), Grid(resolution, resolution)};
    for (Eigen::Index i = 0; i < field.colatitude.size(); ++i) {
      field.colatitude.data()[i] = random.uniform(-1, 1);
      field.longitude.data()[i] = random.uniform(-1, 1);
    }
    const TangentGrid image = transform.synthesize_tangent(gradient, curl);
    const double on_grid = (image.colatitude * field.colatitude + image.longitude * field.longitude).sum();
    Harmonics back_gradient, back_curl;
    transform.adjoint_tangent(field, &back_gradient, &back_curl);
    const double in_harmonics = harmonic_dot(degree, back_gradient, gradient) + harmonic_dot(degree, back_curl, curl);
    const double size = std::sqrt((image.colatitude.square() + image.longitude.square()).sum() *
                                  (field.colatitude.square() + field.longitude.square()).sum());
    EXPECT_GT(size, 1);
    // Measured: 2e-17 of the product of norms.
    EXPECT_NEAR(on_grid, in_harmonics, 1e-15 * size) << "resolution " << resolution;
  }
}

TEST(HarmonicTransform, FilteringScalesASingleHarmonic) {
  constexpr int resolution = 32, degree = 15;
  constexpr double time = 0.0025;
  const HarmonicTransform transform(resolution, degree);
  for (const auto& [l, m] : std::vector<std::pair<int, int>>{{1, 0}, {2, 1}, {5, 5}, {9, 4}, {15, 15}, {15, 0}}) {
    const Grid values = sampled(resolution, [l = l, m = m](const Eigen::Vector3d& p) { return exact_harmonic(l, m, p).real(); });
    Harmonics coefficients = transform.analyze(values);
    scale_degrees(degree, coefficients, [](int k) { return std::exp(-time * k * (k + 1)); });
    // Measured: 4e-15.
    EXPECT_LT((transform.synthesize(coefficients) - std::exp(-time * l * (l + 1)) * values).abs().maxCoeff(), 5e-14) << l << " " << m;
  }
}

TEST(HarmonicTransform, OneTransformServesSeveralThreads) {
  const HarmonicTransform transform(64, 31);
  const Harmonics coefficients = random_harmonics(31, 5);
  const Grid alone = transform.synthesize(coefficients);
  std::vector<int> equal(4, 0);
  {
    std::vector<std::jthread> threads;
    for (int& count : equal)
      threads.emplace_back([&transform, &coefficients, &alone, &count] {
        for (int repeat = 0; repeat < 20; ++repeat) count += (transform.synthesize(coefficients) == alone).all() ? 1 : 0;
      });
  }
  for (const int count : equal) EXPECT_EQ(count, 20);
}

TEST(HarmonicIndex, NumbersEveryCoefficientOnce) {
  for (const int degree : {0, 1, 6}) {
    std::vector<int> seen(static_cast<std::size_t>(harmonic_count(degree)), 0);
    for (int m = 0; m <= degree; ++m)
      for (int l = m; l <= degree; ++l) ++seen.at(static_cast<std::size_t>(harmonic_index(degree, l, m)));
    for (const int count : seen) EXPECT_EQ(count, 1);
  }
}

}  // namespace
}  // namespace spherematch
