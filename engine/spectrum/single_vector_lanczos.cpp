#include "engine/spectrum/eigenbasis.h"

#include <Spectra/SymGEigsShiftSolver.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <numeric>
#include <vector>

#include "engine/mesh/laplacian.h"

namespace spherematch {
namespace {

/// y = (S - sigma M)^-1 x for Spectra.
class VectorShiftInverse {
 public:
  using Scalar = double;

  VectorShiftInverse(const Laplacian& laplacian, const Progress& progress) : laplacian_(laplacian), progress_(progress) {}

  [[nodiscard]] Eigen::Index rows() const { return laplacian_.stiffness.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return rows(); }
  void set_shift(double sigma) {
    solver_.compute(laplacian_.stiffness - sigma * laplacian_.mass);
    if (solver_.info() != Eigen::Success) throw EngineError(ErrorCode::parametrization_failed, "the eigenproblem is singular");
  }
  void perform_op(const double* x, double* y) const {
    progress_.check();
    Eigen::Map<Eigen::VectorXd>(y, rows()) = solver_.solve(Eigen::Map<const Eigen::VectorXd>(x, rows()));
  }

 private:
  const Laplacian& laplacian_;
  const Progress& progress_;
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower> solver_;
};

/// y = M x for Spectra.
class MassProduct {
 public:
  using Scalar = double;

  explicit MassProduct(const SparseMatrix& lower) : mass_(lower.selfadjointView<Eigen::Lower>()) {}

  [[nodiscard]] Eigen::Index rows() const { return mass_.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return rows(); }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Eigen::VectorXd>(y, rows()).noalias() = mass_ * Eigen::Map<const Eigen::VectorXd>(x, rows());
  }

 private:
  SparseMatrix mass_;
};

/// (S - sigma M)^-1 with the pairs already known taken out.
class DeflatedInverse {
 public:
  using Scalar = double;

  DeflatedInverse(VectorShiftInverse& inverse, const MassProduct& mass, const Eigen::MatrixXd& known)
      : inverse_(inverse), mass_(mass), known_(known) {}

  [[nodiscard]] Eigen::Index rows() const { return inverse_.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return rows(); }
  void set_shift(double sigma) { inverse_.set_shift(sigma); }
  void perform_op(const double* x, double* y) const {
    inverse_.perform_op(x, y);
    Eigen::Map<Eigen::VectorXd> result(y, rows());
    Eigen::VectorXd product(rows());
    mass_.perform_op(y, product.data());
    result.noalias() -= known_ * (known_.transpose() * product).eval();
  }

 private:
  VectorShiftInverse& inverse_;
  const MassProduct& mass_;
  const Eigen::MatrixXd& known_;
};

constexpr double kShift = -10.0;  // below the spectrum, so that the shifted matrix is positive definite; of the order of a gap

/// The `wanted` pairs nearest to the shift that `inverse` knows of.
template <typename Inverse>
Eigenbasis lanczos(Inverse& inverse, MassProduct& mass, Eigen::Index wanted, Eigen::Index krylov, Eigen::Index seed) {
  constexpr double kTolerance = 1e-9;
  constexpr int kRestarts = 300;
  Spectra::SymGEigsShiftSolver<Inverse, MassProduct, Spectra::GEigsMode::ShiftInvert> solver(inverse, mass, wanted, krylov, kShift);
  // A start that is not itself an eigenvector (constants are), and another one for each seed: what one start does not see in an
  // eigenspace it never sees.
  Eigen::VectorXd start(inverse.rows());
  for (Eigen::Index i = 0; i < start.size(); ++i) start[i] = 1.0 + static_cast<double>((i * (7919 + 611 * seed)) % 1009) / 1009.0;
  solver.init(start.data());
  const Eigen::Index found = solver.compute(Spectra::SortRule::LargestMagn, kRestarts, kTolerance, Spectra::SortRule::SmallestAlge);
  if (found < wanted) throw EngineError(ErrorCode::parametrization_failed, "the eigenproblem did not converge");
  return {solver.eigenvalues(), solver.eigenvectors()};
}

/// How many eigenvalues lie below `sigma`, by Sylvester's law of inertia.
Eigen::Index count_below(const Laplacian& laplacian, double sigma) {
  const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower> factors(laplacian.stiffness - sigma * laplacian.mass);
  if (factors.info() != Eigen::Success) return 0;  // sigma is an eigenvalue to rounding: nothing can be said
  return (factors.vectorD().array() < 0).count();
}

/// The lowest `count` of both sets, ascending.
Eigenbasis merge(const Eigenbasis& a, const Eigenbasis& b, Eigen::Index count) {
  Eigen::VectorXd values(a.values.size() + b.values.size());
  values << a.values, b.values;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&values](Eigen::Index i, Eigen::Index j) { return values[i] < values[j]; });
  Eigenbasis result{Eigen::VectorXd(count), Eigen::MatrixXd(a.vectors.rows(), count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index i = order[static_cast<std::size_t>(k)];
    result.values[k] = values[i];
    result.vectors.col(k) = i < a.values.size() ? a.vectors.col(i) : b.vectors.col(i - a.values.size());
  }
  return result;
}

}  // namespace

Eigenbasis compute_eigenbasis_by_single_vectors(const Laplacian& laplacian, int count, const Progress& progress) {
  const Eigen::Index vertex_count = laplacian.stiffness.rows();
  const Eigen::Index wanted = std::min<Eigen::Index>(count, vertex_count - 2);
  VectorShiftInverse inverse(laplacian, progress);
  MassProduct mass(laplacian.mass);
  Eigenbasis basis = lanczos(inverse, mass, wanted, std::min<Eigen::Index>(2 * wanted, vertex_count), 0);

  // Lanczos from one vector sees one of several equal eigenvalues, as symmetric surfaces have them. Counting tells how many are
  // missing; they are the lowest of what is left when the known pairs are taken out.
  for (int round = 0; round < 8; ++round) {
    const double sigma = basis.values[wanted - 1] * (1 - 1e-7);
    const Eigen::Index missing = count_below(laplacian, sigma) - (basis.values.array() < sigma).count();
    if (missing <= 0) break;
    const Eigen::MatrixXd known = basis.vectors;
    DeflatedInverse deflated(inverse, mass, known);
    const Eigen::Index more = std::min(missing, vertex_count - 2);
    const Eigenbasis rest = lanczos(deflated, mass, more, std::min<Eigen::Index>(2 * more + 20, vertex_count), round + 1);
    basis = merge(basis, rest, wanted);
  }
  return basis;
}

}  // namespace spherematch
