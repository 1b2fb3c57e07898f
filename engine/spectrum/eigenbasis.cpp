#include "engine/spectrum/eigenbasis.h"

#include <Spectra/SymGEigsShiftSolver.h>

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "engine/mesh/laplacian.h"

namespace spherematch {
namespace {

/// y = (S - sigma M)^-1 x for Spectra.
class ShiftInverse {
 public:
  using Scalar = double;

  ShiftInverse(const Laplacian& laplacian, const Progress& progress) : laplacian_(laplacian), progress_(progress) {}

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

}  // namespace

Eigenbasis compute_eigenbasis(const IntrinsicMesh& mesh, Eigen::Index vertex_count, int count, const Progress& progress) {
  constexpr double kShift = -10.0;  // below the spectrum, so that the shifted matrix is positive definite; of the order of a gap
  constexpr double kTolerance = 1e-9;
  constexpr int kRestarts = 300;
  const Laplacian laplacian = cotangent_laplacian(mesh, vertex_count);
  const Eigen::Index wanted = std::min<Eigen::Index>(count, vertex_count - 2);
  const Eigen::Index krylov = std::min<Eigen::Index>(2 * wanted, vertex_count);

  ShiftInverse inverse(laplacian, progress);
  MassProduct mass(laplacian.mass);
  Spectra::SymGEigsShiftSolver<ShiftInverse, MassProduct, Spectra::GEigsMode::ShiftInvert> solver(inverse, mass, wanted, krylov, kShift);
  // A smooth start that is not itself an eigenvector: constants are.
  Eigen::VectorXd start(vertex_count);
  for (Eigen::Index i = 0; i < vertex_count; ++i) start[i] = 1.0 + static_cast<double>((i * 7919) % 1009) / 1009.0;
  solver.init(start.data());
  const Eigen::Index found = solver.compute(Spectra::SortRule::LargestMagn, kRestarts, kTolerance, Spectra::SortRule::SmallestAlge);
  if (found < wanted) throw EngineError(ErrorCode::parametrization_failed, "the eigenproblem did not converge");
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace spherematch
