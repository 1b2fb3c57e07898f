// (S - sigma M)^-1 on a few vectors at once.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "engine/mesh/laplacian.h"

namespace spherematch {

/// The Cholesky factors of S - sigma M for a shift below the spectrum. Both triangular solves read the factor once for all columns
/// of a block, where memory is what they wait for. Immutable, thread-safe.
class ShiftInverse {
 public:
  static constexpr int width = 8;  ///< columns of a block
  using Block = Eigen::Matrix<double, Eigen::Dynamic, width, Eigen::RowMajor>;

  /// @throws EngineError(parametrization_failed) when the shifted matrix is not positive definite
  ShiftInverse(const Laplacian& laplacian, double sigma);

  /// x becomes (S - sigma M)^-1 x; (V, width).
  void apply(Block& x) const;

 private:
  SparseMatrix factor_;  ///< L of L L^T = P (S - sigma M) P^T, by columns
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, SparseMatrix::StorageIndex> permutation_;
};

}  // namespace spherematch
