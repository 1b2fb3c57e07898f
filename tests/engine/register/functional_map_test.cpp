#include "engine/register/functional_map.h"

#include <gtest/gtest.h>

#include <random>

namespace spherematch {
namespace {

PointValues random_values(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  return PointValues::NullaryExpr(rows, columns, [&] { return normal(random); });
}

TEST(FunctionalMap, ExplainsFunctionsThatAreCombinationsOfTheOthers) {
  const PointValues resting = random_values(200, 6, 1), combination = random_values(6, 6, 2);
  const Eigen::VectorXd masses = random_values(200, 1, 3).cwiseAbs().cast<double>();
  const SpectralDifferences result = spectral_differences(resting, resting * combination, masses, 1);
  EXPECT_LT(result.values.cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_GT(result.explained.minCoeff(), 1 - 1e-6);
}

TEST(FunctionalMap, LeavesWhatIsOrthogonalToTheOthers) {
  // One function of the moving shape is half of a resting one, and half orthogonal to them all.
  const Eigen::VectorXd masses = Eigen::VectorXd::Ones(4);
  PointValues resting(4, 2), moving(4, 2);
  resting << 1, 1, 1, -1, -1, 1, -1, -1;
  const Eigen::Vector4f apart(1, -1, -1, 1);
  moving.col(0) = resting.col(1);
  moving.col(1) = resting.col(0) + apart;
  const SpectralDifferences result = spectral_differences(resting, moving, masses, 1);
  EXPECT_LT(result.values.col(0).norm(), 1e-6);
  EXPECT_LT((result.values.col(1) - apart).norm(), 1e-6);
  EXPECT_NEAR(result.explained[0], 1, 1e-6);
  EXPECT_NEAR(result.explained[1], 0.5, 1e-6);
}

TEST(FunctionalMap, IsThatOfTheNodesWithMass) {
  PointValues resting = random_values(50, 3, 4), moving = -resting;
  Eigen::VectorXd masses = Eigen::VectorXd::Ones(50);
  moving.row(7) *= 100;
  masses[7] = 0;
  const SpectralDifferences result = spectral_differences(resting, moving, masses, 1);
  EXPECT_LT((result.values.row(7) + 99 * resting.row(7)).norm(), 1e-4);
  EXPECT_GT(result.explained.minCoeff(), 1 - 1e-6);
}

TEST(FunctionalMap, ExplainsNothingOfNothing) {
  const SpectralDifferences result = spectral_differences(PointValues::Zero(9, 2), PointValues::Zero(9, 2), Eigen::VectorXd::Ones(9), 1);
  EXPECT_EQ(result.explained.maxCoeff(), 0);
  EXPECT_TRUE(result.values.isZero());
}

}  // namespace
}  // namespace spherematch
