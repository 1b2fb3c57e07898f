// The lowest eigenpairs of the Laplace-Beltrami operator (paper section 4.2).
#pragma once

#include <Eigen/Core>
#include <functional>

#include "engine/data/progress.h"
#include "engine/mesh/laplacian.h"

namespace spherematch {

struct Eigenbasis {
  Eigen::VectorXd values;   ///< (k), ascending, the first zero up to rounding
  Eigen::MatrixXd vectors;  ///< (V, k), orthonormal in the mass inner product
};

/// Solves S v = lambda M v for the `count` lowest eigenpairs, by shift-invert block Lanczos in the mass inner product. None of
/// several equal eigenvalues is missed. Deterministic. `count` is lowered to V - 2 where the mesh is too small.
/// `report` is told how much of the work is done, in [0, 1].
/// @throws EngineError(cancelled, parametrization_failed)
[[nodiscard]] Eigenbasis compute_eigenbasis(const Laplacian& laplacian, int count, const Progress& progress,
                                            const std::function<void(double)>& report = {});

/// The same by a library's shift-invert Lanczos from single vectors, two to three times slower on large meshes: what
/// compute_eigenbasis() is tested against.
[[nodiscard]] Eigenbasis compute_eigenbasis_by_single_vectors(const Laplacian& laplacian, int count, const Progress& progress);

}  // namespace spherematch
