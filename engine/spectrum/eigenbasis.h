// The lowest eigenpairs of the Laplace-Beltrami operator (paper section 4.2).
#pragma once

#include <Eigen/Core>

#include "engine/data/progress.h"
#include "engine/mesh/intrinsic_delaunay.h"

namespace spherematch {

struct Eigenbasis {
  Eigen::VectorXd values;   ///< (k), ascending, the first zero up to rounding
  Eigen::MatrixXd vectors;  ///< (V, k), orthonormal in the mass inner product
};

/// Solves S v = lambda M v for the `count` lowest eigenpairs, cotangent stiffness and consistent mass of `mesh`, by shift-invert
/// Lanczos in the mass inner product. Deterministic. `count` is lowered to V - 2 where the mesh is too small.
/// @throws EngineError(cancelled, parametrization_failed)
[[nodiscard]] Eigenbasis compute_eigenbasis(const IntrinsicMesh& mesh, Eigen::Index vertex_count, int count, const Progress& progress);

}  // namespace spherematch
