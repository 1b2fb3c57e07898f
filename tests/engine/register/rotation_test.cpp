#include "engine/register/rotation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/register/wigner.h"
#include "tests/engine/sphere/spheres.h"

namespace spherematch {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::Random;
using test::random_harmonics;

constexpr double pi = std::numbers::pi;
constexpr int degree = 15;

/// Coefficients of x -> f(R^-1 x).
Harmonics rotated(const Harmonics& f, const Matrix3d& rotation) {
  const std::vector<DegreeVector> full = CoefficientRotation(degree, rotation)(full_coefficients(degree, f));
  Harmonics result = Harmonics::Zero(f.size());
  for (int m = 0; m <= degree; ++m)
    for (int l = m; l <= degree; ++l) result[harmonic_index(degree, l, m)] = full[static_cast<std::size_t>(l)][l + m];
  return result;
}

/// The normalised correlation of f turned by R with g, their means left out.
double correlation(Harmonics f, Harmonics g, const Matrix3d& rotation) {
  f[0] = g[0] = 0;
  return harmonic_dot(degree, rotated(f, rotation), g) / std::sqrt(harmonic_dot(degree, f, f) * harmonic_dot(degree, g, g));
}

double angle_between(const Matrix3d& a, const Matrix3d& b) {
  // By the distance: the trace is blind to small angles.
  return 2 * std::asin(std::min(1.0, (a - b).norm() / std::sqrt(8.0)));
}

TEST(AlignRotations, RecoversAKnownRotation) {
  Random random(1);
  std::vector<Matrix3d> rotations{Matrix3d::Identity(), AngleAxisd(pi, Vector3d::UnitX()).toRotationMatrix(),
                                  AngleAxisd(pi, Vector3d::UnitY()).toRotationMatrix(),
                                  AngleAxisd(pi, Vector3d::UnitZ()).toRotationMatrix()};
  while (rotations.size() < 20) rotations.push_back(random.rotation());
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const Harmonics f = random_harmonics(degree, 10 + i), g = rotated(f, rotations[i]);
    const std::vector<RotationCandidate> found = align_rotations({f}, {g}, degree, {});
    ASSERT_GE(found.size(), 1U);
    // Newton's method ends at steps of 1e-12. Measured: 7e-13.
    EXPECT_LT(angle_between(found.front().rotation, rotations[i]), 1e-11);
    EXPECT_NEAR(found.front().correlation, 1, 1e-12);
    for (const RotationCandidate& candidate : found)
      EXPECT_NEAR(rotation_correlation({f}, {g}, degree, candidate.rotation), candidate.correlation, 1e-12);
    EXPECT_NEAR(rotation_correlation({f}, {g}, degree, Matrix3d::Identity()), correlation(f, g, Matrix3d::Identity()), 1e-12);
  }
}

TEST(AlignRotations, IgnoresTheMeanAndTheScaleOfEachSignal) {
  const Matrix3d rotation = Random(2).rotation();
  const Harmonics f = random_harmonics(degree, 3);
  Harmonics g = 7.5 * rotated(f, rotation);
  g[0] += 100;
  const std::vector<RotationCandidate> found = align_rotations({f}, {g}, degree, {});
  EXPECT_LT(angle_between(found.front().rotation, rotation), 1e-11);
  EXPECT_NEAR(found.front().correlation, 1, 1e-12);
}

TEST(AlignRotations, WeighsSeveralSignalsAlike) {
  // One signal alone would be turned by A, the other, a million times larger, by B; together neither wins by its size.
  const Matrix3d a = Random(3).rotation(), b = Random(4).rotation();
  const Harmonics f = random_harmonics(degree, 5), h = 1e6 * random_harmonics(degree, 6);
  ASSERT_GT((a - b).squaredNorm(), 3);
  MatchParameters parameters;
  parameters.candidate_separation = 3;
  parameters.candidate_threshold = 0.3;
  parameters.max_candidates = 4;
  const std::vector<RotationCandidate> found = align_rotations({f, h}, {rotated(f, a), rotated(h, b)}, degree, parameters);
  ASSERT_GE(found.size(), 2U);
  for (const Matrix3d& rotation : {a, b}) {
    double nearest = pi;
    for (std::size_t i = 0; i < 2; ++i) nearest = std::min(nearest, angle_between(found[i].rotation, rotation));
    EXPECT_LT(nearest, 0.05);  // the other signal tilts each peak; measured: 0.024
  }
  EXPECT_NEAR(found[0].correlation, 0.5, 0.02);
  EXPECT_NEAR(found[1].correlation, 0.5, 0.02);
}

TEST(AlignRotations, FindsExactlyTheFourTurnsOfAnEllipsoidsSymmetry) {
  // Even in each coordinate up to sign: keeps l, m even with real coefficients.
  Harmonics f = random_harmonics(degree, 7);
  for (int m = 0; m <= degree; ++m)
    for (int l = m; l <= degree; ++l) {
      std::complex<double>& a = f[harmonic_index(degree, l, m)];
      a = l % 2 == 0 && m % 2 == 0 ? std::complex<double>(a.real(), 0) : 0;
    }
  const Matrix3d rotation = Random(8).rotation();
  MatchParameters parameters;
  parameters.candidate_separation = 3;
  parameters.candidate_threshold = 0.1;
  parameters.max_candidates = 16;
  const std::vector<RotationCandidate> found = align_rotations({f}, {rotated(f, rotation)}, degree, parameters);
  ASSERT_EQ(found.size(), 4U);
  for (const RotationCandidate& candidate : found) EXPECT_NEAR(candidate.correlation, 1, 1e-12);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) EXPECT_NEAR((found[i].rotation - found[j].rotation).squaredNorm(), 8, 1e-11);
  // One of them is the rotation itself, the others follow a half turn about an axis.
  for (const Matrix3d& turn : {Matrix3d(Matrix3d::Identity()), AngleAxisd(pi, Vector3d::UnitX()).toRotationMatrix(),
                               AngleAxisd(pi, Vector3d::UnitY()).toRotationMatrix(), AngleAxisd(pi, Vector3d::UnitZ()).toRotationMatrix()})
    EXPECT_EQ(std::count_if(found.begin(), found.end(), [&](const auto& c) { return angle_between(c.rotation, rotation * turn) < 1e-11; }),
              1);
}

TEST(AlignRotations, CandidatesAreSeparatedMaximaInOrder) {
  Random random(9);
  MatchParameters parameters;
  parameters.candidate_separation = 3;
  parameters.candidate_threshold = 0.5;
  parameters.max_candidates = 8;
  std::size_t several = 0;
  for (std::uint64_t seed = 20; seed < 26; ++seed) {
    // Unrelated signals: many low maxima.
    const Harmonics f = random_harmonics(degree, seed), g = random_harmonics(degree, seed + 100);
    const std::vector<RotationCandidate> found = align_rotations({f}, {g}, degree, parameters);
    ASSERT_GE(found.size(), 1U);
    ASSERT_LE(found.size(), 8U);
    several += found.size() > 2 ? 1U : 0U;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const RotationCandidate& candidate = found[i];
      EXPECT_LT((candidate.rotation * candidate.rotation.transpose() - Matrix3d::Identity()).norm(), 1e-12);
      EXPECT_NEAR(candidate.rotation.determinant(), 1, 1e-12);
      EXPECT_NEAR(candidate.correlation, correlation(f, g, candidate.rotation), 1e-12);
      if (i > 0) {
        EXPECT_LE(candidate.correlation, found[i - 1].correlation);
      }
      EXPECT_GE(candidate.correlation, 0.5 * found[0].correlation);
      for (std::size_t j = 0; j < i; ++j) EXPECT_GT((candidate.rotation - found[j].rotation).squaredNorm(), 3);
      for (int k = 0; k < 20; ++k)
        for (const double size : {1e-5, 1e-2}) {
          const Matrix3d nearby = AngleAxisd(size, random.unit_vector()).toRotationMatrix() * candidate.rotation;
          EXPECT_LT(correlation(f, g, nearby), candidate.correlation + 1e-14) << "not a maximum";
        }
    }
    for (int k = 0; k < 200; ++k) EXPECT_LT(correlation(f, g, random.rotation()), found[0].correlation) << "not the best";
  }
  EXPECT_GE(several, 3U);
}

TEST(AlignRotations, ObeysItsLimits) {
  const Harmonics f = random_harmonics(degree, 30), g = random_harmonics(degree, 31);
  MatchParameters parameters;
  parameters.candidate_threshold = 1;
  parameters.candidate_separation = 0.5;
  parameters.max_candidates = 5;
  EXPECT_EQ(align_rotations({f}, {g}, degree, parameters).size(), 5U);
  parameters.max_candidates = 1;
  EXPECT_EQ(align_rotations({f}, {g}, degree, parameters).size(), 1U);
}

TEST(AlignRotations, GivesARotationEvenForSignalsWithoutShape) {
  const std::vector<RotationCandidate> found =
      align_rotations({Harmonics::Zero(harmonic_count(degree))}, {Harmonics::Zero(harmonic_count(degree))}, degree, {});
  ASSERT_GE(found.size(), 1U);
  for (const RotationCandidate& candidate : found) {
    EXPECT_LT((candidate.rotation * candidate.rotation.transpose() - Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_EQ(candidate.correlation, 0);
  }
}

TEST(HalfRotation, IsTheShorterSquareRoot) {
  Random random(10);
  for (int i = 0; i < 200; ++i) {
    const double angle = i < 4 ? std::array{0.0, 1e-9, pi, pi - 1e-9}[static_cast<std::size_t>(i)] : random.uniform(0, pi);
    const Matrix3d rotation = AngleAxisd(angle, random.unit_vector()).toRotationMatrix(), half = half_rotation(rotation);
    EXPECT_LT((half * half - rotation).norm(), 1e-14);
    EXPECT_LE(angle_between(half, Matrix3d::Identity()), pi / 2 + 1e-7);
    // The inverse's half is the half's inverse, which is what makes the split symmetric; a half turn has two axes.
    if (angle < 3) {
      EXPECT_LT((half_rotation(rotation.transpose()) - half.transpose()).norm(), 1e-14);
    }
  }
}

}  // namespace
}  // namespace spherematch
