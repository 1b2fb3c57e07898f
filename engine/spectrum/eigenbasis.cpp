#include "engine/spectrum/eigenbasis.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/spectrum/shift_inverse.h"

namespace spherematch {
namespace {

constexpr double kShift = -10.0;  // below the spectrum, so that the shifted matrix is positive definite; of the order of a gap
constexpr double kTolerance = 1e-9;
constexpr Eigen::Index kWidth = ShiftInverse::width;

using Block = Eigen::Matrix<double, Eigen::Dynamic, kWidth>;
using Coupling = Eigen::Matrix<double, kWidth, kWidth>;

/// A growing Krylov basis of A = (S - sigma M)^-1 M, orthonormal in the inner product of M, and the projection of A to it.
class KrylovBasis {
 public:
  KrylovBasis(const Laplacian& laplacian, Eigen::Index most_vectors)
      : mass_(laplacian.mass.selfadjointView<Eigen::Lower>()),
        inverse_(laplacian, kShift),
        basis_(mass_.rows(), most_vectors),
        projected_(Eigen::MatrixXd::Zero(most_vectors, most_vectors)),
        next_(mass_.rows(), kWidth),
        mass_next_(mass_.rows(), kWidth) {
    randomize();
  }

  [[nodiscard]] Eigen::Index size() const { return size_; }
  [[nodiscard]] Eigen::Index capacity() const { return basis_.cols(); }
  [[nodiscard]] auto vectors() const { return basis_.leftCols(size_); }
  /// V^T M A V, its upper triangle.
  [[nodiscard]] auto projected() const { return projected_.topLeftCorner(size_, size_); }
  /// A V = V T + Q C: what leaves the basis comes from its last block, through this C.
  [[nodiscard]] const Coupling& coupling() const { return coupling_; }

  /// Takes the next block into the basis and makes the one after it.
  void extend() {
    const Eigen::Index at = size_;
    basis_.middleCols(at, kWidth) = next_;
    size_ += kWidth;
    ShiftInverse::Block image = mass_next_;
    inverse_.apply(image);
    next_ = image;
    // In exact arithmetic only the last two blocks matter; what rounding lets in of the others is taken out afterwards, when the
    // large parts are gone, so that one pass over the whole basis is enough.
    coupling_.setIdentity();
    mass_next_.noalias() = mass_ * next_;
    project_out(std::max<Eigen::Index>(0, at - kWidth), at);
    normalize();
    project_out(0, at);
    normalize();
  }

  /// Puts random vectors, orthogonal to the basis, in the place of the next block: for directions that the basis cannot see.
  void randomize() {
    for (Eigen::Index j = 0; j < kWidth; ++j)
      for (Eigen::Index i = 0; i < next_.rows(); ++i) next_(i, j) = random();
    for (int pass = 0; pass < 2; ++pass) {
      mass_next_.noalias() = mass_ * next_;
      next_.noalias() -= vectors() * (vectors().transpose() * mass_next_).eval();
      normalize();
    }
  }

 private:
  /// Takes the basis vectors from `first` on out of the next block, whose coefficients belong to the columns at `column`.
  void project_out(Eigen::Index first, Eigen::Index column) {
    const auto part = basis_.middleCols(first, size_ - first);
    const Eigen::MatrixXd coefficients = part.transpose() * mass_next_;
    next_.noalias() -= part * coefficients;
    projected_.block(first, column, size_ - first, kWidth) += coefficients * coupling_;
  }

  /// Makes the next block orthonormal, and records in the coupling by what it was multiplied.
  void normalize() {
    mass_next_.noalias() = mass_ * next_;
    const Eigen::SelfAdjointEigenSolver<Coupling> gram(next_.transpose() * mass_next_);
    const Eigen::Matrix<double, kWidth, 1> lengths = gram.eigenvalues().cwiseMax(1e-300).cwiseSqrt();
    const Coupling turn = gram.eigenvectors() * lengths.cwiseInverse().asDiagonal();
    next_ = (next_ * turn).eval();
    mass_next_ = (mass_next_ * turn).eval();
    coupling_ = (lengths.asDiagonal() * gram.eigenvectors().transpose() * coupling_).eval();
  }

  /// Xorshift, between -1/2 and 1/2.
  double random() {
    random_ ^= random_ << 13;
    random_ ^= random_ >> 7;
    random_ ^= random_ << 17;
    return static_cast<double>(random_ >> 11) * 0x1p-53 - 0.5;
  }

  const SparseMatrix mass_;
  const ShiftInverse inverse_;
  Eigen::MatrixXd basis_;
  Eigen::MatrixXd projected_;
  Eigen::Index size_ = 0;
  Block next_, mass_next_;
  Coupling coupling_ = Coupling::Identity();
  std::uint64_t random_ = 0x9E3779B97F4A7C15;
};

/// Eigenpairs of the projection, as far as they matter.
struct RitzPairs {
  Eigen::VectorXd values;   ///< (k), of the Laplacian, ascending
  Eigen::MatrixXd weights;  ///< (basis size, k)
  bool converged = false;
};

RitzPairs ritz_pairs(const KrylovBasis& basis, Eigen::Index wanted) {
  const Eigen::MatrixXd projected = basis.projected().selfadjointView<Eigen::Upper>();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(projected);
  const Eigen::VectorXd inverted = solver.eigenvalues().tail(wanted).reverse();
  RitzPairs pairs{kShift + inverted.cwiseInverse().array(), solver.eigenvectors().rightCols(wanted).rowwise().reverse()};
  const Eigen::VectorXd residuals = (basis.coupling() * pairs.weights.bottomRows(kWidth)).colwise().norm();
  pairs.converged = (residuals.array() <= kTolerance * inverted.array()).all();
  return pairs;
}

/// By Sylvester's law of inertia: how many eigenvalues below the last are not among `values`.
Eigen::Index missing(const Laplacian& laplacian, const Eigen::VectorXd& values) {
  const double sigma = values[values.size() - 1] * (1 - 1e-7);
  const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower> factors(laplacian.stiffness - sigma * laplacian.mass);
  if (factors.info() != Eigen::Success) return 0;  // sigma is an eigenvalue to rounding: nothing can be said
  return (factors.vectorD().array() < 0).count() - (values.array() < sigma).count();
}

Eigen::MatrixXd assemble(const KrylovBasis& basis, const Eigen::MatrixXd& weights, const Progress& progress) {
  constexpr Eigen::Index rows_at_once = 8192;
  Eigen::MatrixXd vectors(basis.vectors().rows(), weights.cols());
  for (Eigen::Index row = 0; row < vectors.rows(); row += rows_at_once) {
    progress.check();
    const Eigen::Index rows = std::min(rows_at_once, vectors.rows() - row);
    vectors.middleRows(row, rows).noalias() = basis.vectors().middleRows(row, rows) * weights;
  }
  return vectors;
}

/// For meshes so small that the Krylov basis would fill the space.
Eigenbasis solve_densely(const Laplacian& laplacian, Eigen::Index wanted) {
  const Eigen::MatrixXd stiffness = Eigen::MatrixXd(laplacian.stiffness).selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd mass = Eigen::MatrixXd(laplacian.mass).selfadjointView<Eigen::Lower>();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass);
  return {solver.eigenvalues().head(wanted), solver.eigenvectors().leftCols(wanted)};
}

}  // namespace

Eigenbasis compute_eigenbasis(const Laplacian& laplacian, int count, const Progress& progress, const std::function<void(double)>& report) {
  progress.check();
  const Eigen::Index vertices = laplacian.stiffness.rows(), wanted = std::min<Eigen::Index>(count, vertices - 2);
  // Measured on many meshes: 2.6 to 3 vectors for each pair, fewer of them the more pairs.
  const Eigen::Index first_look = 27 * wanted / 10 + 4 * kWidth, look_again = wanted / 5 + kWidth, most = 6 * wanted + 12 * kWidth;
  if (vertices <= first_look + look_again + kWidth) return solve_densely(laplacian, wanted);

  KrylovBasis basis(laplacian, std::min(most, vertices - kWidth));
  Eigen::Index look = first_look;
  while (basis.size() + kWidth <= basis.capacity()) {
    progress.check();
    basis.extend();
    // The work of a step grows with the basis.
    const double part = static_cast<double>(basis.size()) / static_cast<double>(first_look + look_again);
    if (report) report(std::min(0.95, part * part));
    if (basis.size() < look) continue;
    look = basis.size() + look_again;
    const RitzPairs pairs = ritz_pairs(basis, wanted);
    if (!pairs.converged) continue;
    if (missing(laplacian, pairs.values) <= 0) return {pairs.values, assemble(basis, pairs.weights, progress)};
    // More equal eigenvalues than a block is wide show themselves to vectors from elsewhere only.
    basis.randomize();
  }
  throw EngineError(ErrorCode::parametrization_failed, "the eigenproblem did not converge");
}

}  // namespace spherematch
