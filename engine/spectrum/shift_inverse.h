// (S - sigma M)^-1 on a few vectors at once.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "engine/mesh/laplacian.h"

namespace spherematch {

/// The Cholesky factors of S - sigma M for a shift below the spectrum. Both triangular solves read the factor once for all columns
/// of a block, where memory is what they wait for. Immutable, thread-safe. There is one for double and 8 columns, and one for float and
/// 32 columns, which factorises in double too.
template <typename Scalar, int columns>
class BlockShiftInverse {
 public:
  static constexpr int width = columns;  ///< of a block
  using Block = Eigen::Matrix<Scalar, Eigen::Dynamic, width, Eigen::RowMajor>;

  /// @throws EngineError(parametrization_failed) when the shifted matrix is not positive definite
  BlockShiftInverse(const Laplacian& laplacian, double sigma);

  /// x becomes (S - sigma M)^-1 x; (V, width).
  void apply(Block& x) const;

  /// The same of a block whose rows are in the order of elimination: that of vertex v at place(v).
  void apply_in_place(Block& x) const;
  [[nodiscard]] Eigen::Index place(Eigen::Index v) const { return permutation_.indices()[v]; }

 private:
  Eigen::SparseMatrix<Scalar> factor_;  ///< L of L L^T = P (S - sigma M) P^T, by columns; its diagonal inverted
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, SparseMatrix::StorageIndex> permutation_;
};

using ShiftInverse = BlockShiftInverse<double, 8>;
using FloatShiftInverse = BlockShiftInverse<float, 32>;

}  // namespace spherematch
