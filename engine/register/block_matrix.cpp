#include "engine/register/block_matrix.h"

#include <Eigen/LU>
#include <algorithm>

namespace spherematch {
namespace {

using Block = Eigen::Array4f;

/// The product with the two components of x from `first` on, before its halves are added.
Block halves(const Block& block, const Eigen::VectorXf& x, Eigen::Index first) {
  return block * Block(x[first], x[first], x[first + 1], x[first + 1]);
}

/// In double precision: a sum of twenty thousand products.
double dot(const Eigen::VectorXf& a, const Eigen::VectorXf& b) { return a.cast<double>().dot(b.cast<double>()); }

}  // namespace

std::int32_t BlockPattern::slot(std::int32_t row, std::int32_t column_wanted) const {
  const auto first = column.begin() + start[static_cast<std::size_t>(row)],
             last = column.begin() + start[static_cast<std::size_t>(row) + 1];
  return static_cast<std::int32_t>(std::lower_bound(first, last, column_wanted) - column.begin());
}

void BlockMatrix::multiply(const Eigen::VectorXf& x, Eigen::VectorXf& result) const {
  for (std::size_t i = 0; i + 1 < pattern_->start.size(); ++i) {
    Block sum = Block::Zero();
    for (std::int32_t j = pattern_->start[i]; j < pattern_->start[i + 1]; ++j) {
      const auto slot = static_cast<std::size_t>(j);
      sum += halves(blocks_[slot], x, 2 * pattern_->column[slot]);
    }
    result.segment<2>(2 * static_cast<Eigen::Index>(i)) = (sum.head<2>() + sum.tail<2>()).matrix();
  }
}

std::vector<Block> BlockMatrix::inverse_diagonal() const {
  std::vector<Block> result(pattern_->start.size() - 1);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto row = static_cast<std::int32_t>(i);
    const Block& block = blocks_[static_cast<std::size_t>(pattern_->slot(row, row))];
    const Eigen::Matrix2d inverse = Eigen::Map<const Eigen::Matrix2f>(block.data()).cast<double>().inverse();
    result[i] = Eigen::Map<const Eigen::Array4d>(inverse.data()).cast<float>();
  }
  return result;
}

Eigen::VectorXd BlockMatrix::solve(const Eigen::VectorXd& right, double tolerance, int most_iterations) const {
  const std::vector<Block> inverse = inverse_diagonal();
  const auto precondition = [&inverse](const Eigen::VectorXf& r, Eigen::VectorXf& z) {
    for (std::size_t i = 0; i < inverse.size(); ++i) {
      const auto first = 2 * static_cast<Eigen::Index>(i);
      const Block sum = halves(inverse[i], r, first);
      z.segment<2>(first) = (sum.head<2>() + sum.tail<2>()).matrix();
    }
  };
  Eigen::VectorXf u = Eigen::VectorXf::Zero(right.size()), r = right.cast<float>(), z(r.size()), product(r.size());
  precondition(r, z);
  Eigen::VectorXf p = z;
  double rz = dot(r, z);
  const double stop = tolerance * tolerance * dot(r, r);
  for (int i = 0; i < most_iterations; ++i) {
    multiply(p, product);
    const double curvature = dot(p, product);
    if (!(curvature > 0)) break;
    const auto step = static_cast<float>(rz / curvature);
    u += step * p;
    r -= step * product;
    if (!(dot(r, r) > stop)) break;
    precondition(r, z);
    const double next = dot(r, z);
    p = z + static_cast<float>(next / rz) * p;
    rz = next;
  }
  return u.cast<double>();
}

}  // namespace spherematch
