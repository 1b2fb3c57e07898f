#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/mesh/intrinsic_delaunay.h"
#include "engine/mesh/spatial_order.h"
#include "engine/spectrum/eigenbasis.h"

namespace spherematch {

namespace {

FloatEigenbasis solve(const TriMesh& mesh, const Laplacian& laplacian, const PreprocessParameters& parameters, int threads,
                      const Progress& progress, const std::function<void(double)>& report) {
  if (parameters.multilevel_eigenbasis && !parameters.single_vector_lanczos) {
    if (auto basis = compute_eigenbasis_by_levels(mesh, laplacian, parameters.eigenpairs, threads, progress, report))
      return *std::move(basis);
  }
  const Eigenbasis basis = parameters.single_vector_lanczos
                               ? compute_eigenbasis_by_single_vectors(laplacian, parameters.eigenpairs, progress)
                               : compute_eigenbasis(laplacian, parameters.eigenpairs, progress, report);
  return {basis.values, basis.vectors.cast<float>()};
}

/// The first pair is known: zero, and a constant. On a round body other pairs add little to the signatures at large times, less than the
/// rounding of a constant that is only nearly one.
void set_constant_pair(FloatEigenbasis& basis, const SparseMatrix& mass) {
  const Eigen::VectorXd weights = mass.selfadjointView<Eigen::Lower>() * Eigen::VectorXd::Ones(mass.rows());
  const double total = weights.sum();
  basis.values[0] = 0;
  basis.vectors.col(0).setConstant(static_cast<float>(1 / std::sqrt(total)));
  for (Eigen::Index k = 1; k < basis.vectors.cols(); ++k)
    basis.vectors.col(k).array() -= static_cast<float>(weights.dot(basis.vectors.col(k).cast<double>()) / total);
}

/// Row order[i] of the result is row i of `vectors`. In pieces of a column, so that no more than one column is held twice.
void restore_order(Eigen::MatrixXf& vectors, const std::vector<std::int32_t>& order) {
  Eigen::VectorXf column(vectors.rows());
  for (Eigen::Index k = 0; k < vectors.cols(); ++k) {
    column = vectors.col(k);
    for (std::size_t i = 0; i < order.size(); ++i) vectors(order[i], k) = column[static_cast<Eigen::Index>(i)];
  }
}

}  // namespace

FloatEigenbasis surface_eigenbasis(const TriMesh& mesh, const PreprocessParameters& parameters, int threads, const Progress& progress,
                                   const std::function<void(double)>& report) {
  progress.check();
  const std::vector<std::int32_t> order = spatial_order(mesh.vertices);
  const TriMesh local = renumbered(mesh, order);
  IntrinsicMesh intrinsic = intrinsic_mesh(local);
  make_delaunay(intrinsic);
  progress.check();
  const Laplacian laplacian = cotangent_laplacian(intrinsic, local.vertex_count());
  FloatEigenbasis basis = solve(local, laplacian, parameters, threads, progress, report);
  set_constant_pair(basis, laplacian.mass);
  restore_order(basis.vectors, order);
  return basis;
}

}  // namespace spherematch
