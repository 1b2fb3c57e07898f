// Stiffness and mass by rows, in single precision, for products with many vectors at once. Internal to engine/spectrum.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/mesh/laplacian.h"

namespace spherematch {

/// Many functions on the vertices: (V, m), all values of a vertex side by side. m is a multiple of Pencil::group.
using FloatBlock = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Products are made of the differences along the edges, so that constants go to nothing exactly and smooth functions lose no digits.
/// Immutable, thread-safe.
class Pencil {
 public:
  static constexpr int group = 16;  ///< columns worked on together

  explicit Pencil(const Laplacian& laplacian);

  [[nodiscard]] Eigen::Index rows() const { return static_cast<Eigen::Index>(diagonal_.size()); }
  [[nodiscard]] float lumped_mass(Eigen::Index row) const { return lumped_[static_cast<std::size_t>(row)]; }
  /// Of the stiffness.
  [[nodiscard]] float diagonal(Eigen::Index row) const { return diagonal_[static_cast<std::size_t>(row)]; }

  /// A bound of the eigenvalues of D^-1 S, where D is the diagonal of S (Gershgorin): two where no weight is negative.
  [[nodiscard]] double highest_frequency() const { return highest_frequency_; }

  /// One row of S x and of M x, the columns from `first` on, `group` of them. x points at the first of these in row 0.
  void multiply(Eigen::Index row, const float* x, Eigen::Index stride, float* stiffness, float* mass) const;

  /// Rows [first, first + count) of S x and M x; both products are (count or more, m).
  void multiply(const FloatBlock& x, Eigen::Index first, Eigen::Index count, FloatBlock& stiffness, FloatBlock& mass) const;

 private:
  struct Entry {
    std::int32_t column;
    float stiffness, mass;
  };
  std::vector<std::int64_t> start_;  ///< (V + 1)
  std::vector<Entry> entries_;       ///< off the diagonal
  std::vector<float> lumped_;        ///< row sums of the mass
  std::vector<float> diagonal_;
  double highest_frequency_ = 0;
};

}  // namespace spherematch
