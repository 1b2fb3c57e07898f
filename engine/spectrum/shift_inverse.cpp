#include "engine/spectrum/shift_inverse.h"

#include <Eigen/SparseCholesky>

#include "engine/data/error.h"

namespace spherematch {

namespace {

template <typename Block>
auto row(Block& x, SparseMatrix::StorageIndex i) {
  using Row = Eigen::Matrix<typename Block::Scalar, 1, Block::ColsAtCompileTime>;
  return Eigen::Map<Row>(x.data() + static_cast<Eigen::Index>(i) * Block::ColsAtCompileTime);
}

template <typename Factor, typename Block>
void solve_lower(const Factor& factor, Block& x) {
  const auto *start = factor.outerIndexPtr(), *index = factor.innerIndexPtr();
  const auto* value = factor.valuePtr();
  for (SparseMatrix::StorageIndex j = 0; j < factor.cols(); ++j) {
    // The diagonal comes first in each column.
    const auto solved = (row(x, j) * value[start[j]]).eval();
    row(x, j) = solved;
    for (auto k = start[j] + 1; k < start[j + 1]; ++k) row(x, index[k]) -= value[k] * solved;
  }
}

template <typename Factor, typename Block>
void solve_upper(const Factor& factor, Block& x) {
  const auto *start = factor.outerIndexPtr(), *index = factor.innerIndexPtr();
  const auto* value = factor.valuePtr();
  for (auto j = static_cast<SparseMatrix::StorageIndex>(factor.cols()) - 1; j >= 0; --j) {
    auto sum = row(x, j).eval();
    for (auto k = start[j] + 1; k < start[j + 1]; ++k) sum -= value[k] * row(x, index[k]);
    row(x, j) = sum * value[start[j]];
  }
}

}  // namespace

template <typename Scalar, int columns>
BlockShiftInverse<Scalar, columns>::BlockShiftInverse(const Laplacian& laplacian, double sigma) {
  const Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower> cholesky(laplacian.stiffness - sigma * laplacian.mass);
  if (cholesky.info() != Eigen::Success) throw EngineError(ErrorCode::parametrization_failed, "the eigenproblem is singular");
  factor_ = cholesky.matrixL().nestedExpression().template cast<Scalar>();
  permutation_ = cholesky.permutationP();
  for (Eigen::Index j = 0; j < factor_.cols(); ++j) {
    Scalar& diagonal = factor_.valuePtr()[factor_.outerIndexPtr()[j]];
    diagonal = 1 / diagonal;
  }
}

template <typename Scalar, int columns>
void BlockShiftInverse<Scalar, columns>::apply(Block& x) const {
  x = permutation_ * x;
  apply_in_place(x);
  x = permutation_.inverse() * x;
}

template <typename Scalar, int columns>
void BlockShiftInverse<Scalar, columns>::apply_in_place(Block& x) const {
  solve_lower(factor_, x);
  solve_upper(factor_, x);
}

template class BlockShiftInverse<double, 8>;
template class BlockShiftInverse<float, 32>;

}  // namespace spherematch
