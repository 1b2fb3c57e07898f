// A symmetric matrix of 2 x 2 blocks, one for each two neighbouring nodes, and the solution of its equations.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace spherematch {

/// Which blocks there are: those of row i are start[i] to start[i + 1] - 1, at ascending columns.
struct BlockPattern {
  std::vector<std::int32_t> start, column;

  /// Of an entry that exists.
  [[nodiscard]] std::int32_t slot(std::int32_t row, std::int32_t column_wanted) const;
};

/// In single precision, which halves the memory that each product reads and is by far enough for a step of a flow. Refers to the pattern.
class BlockMatrix {
 public:
  explicit BlockMatrix(const BlockPattern& pattern) : pattern_(&pattern), blocks_(pattern.column.size(), Block::Zero()) {}

  /// Adds to the block at a slot of the pattern.
  void add(std::int32_t slot, const Eigen::Matrix2d& block) {
    blocks_[static_cast<std::size_t>(slot)] += Eigen::Map<const Eigen::Array4d>(block.data()).cast<float>();
  }

  /// Solves for a positive definite matrix by conjugate gradients, preconditioned by the diagonal blocks, until the residual has fallen to
  /// `tolerance` of the right-hand side (two components per row) or `most_iterations` are done. Zero where the matrix is not definite.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right, double tolerance, int most_iterations) const;

 private:
  using Block = Eigen::Array4f;  ///< column by column

  void multiply(const Eigen::VectorXf& x, Eigen::VectorXf& result) const;
  [[nodiscard]] std::vector<Block> inverse_diagonal() const;

  const BlockPattern* pattern_;
  std::vector<Block> blocks_;
};

}  // namespace spherematch
