#include "engine/spectrum/shift_inverse.h"

#include <Eigen/SparseCholesky>

#include "engine/data/error.h"

namespace spherematch {

namespace {

using Row = Eigen::Matrix<double, 1, ShiftInverse::width>;

auto row(ShiftInverse::Block& x, SparseMatrix::StorageIndex i) {
  return Eigen::Map<Row>(x.data() + static_cast<Eigen::Index>(i) * ShiftInverse::width);
}

void solve_lower(const SparseMatrix& factor, ShiftInverse::Block& x) {
  const auto *start = factor.outerIndexPtr(), *index = factor.innerIndexPtr();
  const double* value = factor.valuePtr();
  for (SparseMatrix::StorageIndex j = 0; j < factor.cols(); ++j) {
    // The diagonal comes first in each column.
    const Row solved = row(x, j) / value[start[j]];
    row(x, j) = solved;
    for (auto k = start[j] + 1; k < start[j + 1]; ++k) row(x, index[k]) -= value[k] * solved;
  }
}

void solve_upper(const SparseMatrix& factor, ShiftInverse::Block& x) {
  const auto *start = factor.outerIndexPtr(), *index = factor.innerIndexPtr();
  const double* value = factor.valuePtr();
  for (auto j = static_cast<SparseMatrix::StorageIndex>(factor.cols()) - 1; j >= 0; --j) {
    Row sum = row(x, j);
    for (auto k = start[j] + 1; k < start[j + 1]; ++k) sum -= value[k] * row(x, index[k]);
    row(x, j) = sum / value[start[j]];
  }
}

}  // namespace

ShiftInverse::ShiftInverse(const Laplacian& laplacian, double sigma) {
  const Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower> cholesky(laplacian.stiffness - sigma * laplacian.mass);
  if (cholesky.info() != Eigen::Success) throw EngineError(ErrorCode::parametrization_failed, "the eigenproblem is singular");
  factor_ = cholesky.matrixL();
  permutation_ = cholesky.permutationP();
}

void ShiftInverse::apply(Block& x) const {
  x = permutation_ * x;
  solve_lower(factor_, x);
  solve_upper(factor_, x);
  x = permutation_.inverse() * x;
}

}  // namespace spherematch
