#include "engine/register/block_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstdlib>

#include "tests/engine/sphere/spheres.h"

namespace spherematch {
namespace {

/// Blocks between numbers that differ by at most two.
BlockPattern band(std::int32_t rows) {
  BlockPattern pattern;
  pattern.start.push_back(0);
  for (std::int32_t i = 0; i < rows; ++i) {
    for (std::int32_t j = std::max(0, i - 2); j <= std::min(rows - 1, i + 2); ++j) pattern.column.push_back(j);
    pattern.start.push_back(static_cast<std::int32_t>(pattern.column.size()));
  }
  return pattern;
}

TEST(BlockMatrix, SolvesAsADenseFactorisationDoes) {
  constexpr std::int32_t kRows = 40;
  const BlockPattern pattern = band(kRows);
  BlockMatrix matrix(pattern);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(2 * kRows, 2 * kRows);
  test::Random random(3);
  // Positive definite: a sum of squares over neighbours, a little on the diagonal; added in two parts.
  for (std::int32_t i = 0; i < kRows; ++i)
    for (std::int32_t j = i; j <= std::min(kRows - 1, i + 2); ++j) {
      Eigen::Matrix<double, 2, 4> factor;
      for (double& value : factor.reshaped()) value = random.uniform(-1, 1);
      const Eigen::Matrix4d square = factor.transpose() * factor + 0.1 * Eigen::Matrix4d::Identity();
      const std::int32_t nodes[2] = {i, j};
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) {
          matrix.add(pattern.slot(nodes[a], nodes[b]), square.block<2, 2>(2 * a, 2 * b));
          dense.block<2, 2>(2 * nodes[a], 2 * nodes[b]) += square.block<2, 2>(2 * a, 2 * b);
        }
    }
  Eigen::VectorXd right(2 * kRows);
  for (double& value : right) value = random.uniform(-1, 1);
  const Eigen::VectorXd exact = dense.ldlt().solve(right);
  EXPECT_LT((matrix.solve(right, 1e-6, 1000) - exact).norm(), 1e-4 * exact.norm());
  // The tolerance is one of the residual.
  const Eigen::VectorXd roughly = matrix.solve(right, 0.1, 1000);
  EXPECT_LE((right - dense * roughly).norm(), 0.1001 * right.norm());
  EXPECT_GT((right - dense * roughly).norm(), 1e-3 * right.norm());
  EXPECT_GT((right - dense * matrix.solve(right, 1e-6, 2)).norm(), 1e-2 * right.norm());
}

TEST(BlockMatrix, WithoutEntriesLeavesEverythingWhereItIs) {
  const BlockPattern pattern = band(5);
  EXPECT_EQ(BlockMatrix(pattern).solve(Eigen::VectorXd::Ones(10), 0.01, 10).norm(), 0);
}

}  // namespace
}  // namespace spherematch
