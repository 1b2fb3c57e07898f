// The lowest eigenpairs of the Laplace-Beltrami operator (paper section 4.2).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "engine/data/parameters.h"
#include "engine/data/progress.h"
#include "engine/data/tri_mesh.h"
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

/// Eigenpairs in single precision.
struct FloatEigenbasis {
  Eigen::VectorXd values;   ///< (k), ascending, the first about zero
  Eigen::MatrixXf vectors;  ///< (V, k), orthonormal in the mass inner product up to single precision (2e-6)
};

/// The same pairs, to the accuracy that signatures need, twenty times faster on large meshes: a hierarchy of subspaces (Nasikun &
/// Hildebrandt 2022). The pairs of a mesh of some hundred vertices are interpolated to ever finer ones, and there improved by inverse
/// iteration, or on the largest levels by smoothing, and Rayleigh-Ritz projection.
///
/// Values are never below the exact ones by more than rounding, and above them by less than 1e-4 of them in the lower half of the
/// pairs and 5e-3 in the upper (measured: see the tests). No pair is missed: on the finest level of at most 12,000 vertices they
/// are counted by Sylvester's law of inertia. The residuals of all pairs are checked on the finest level, and lead to further
/// rounds where they are too large. Nothing where the mesh is too small, cannot be coarsened (mesh/coarsen.h), or does not fulfil
/// these checks.
///
/// `laplacian` is that of `mesh`, which is closed, of unit area, and best in spatial order (mesh/spatial_order.h). Uses up to `threads`
/// threads; the bytes do not depend on their number. Levels of more vertices than `most_factorized` are smoothed instead of factorised:
/// that takes less memory, and can be cancelled at any time. Memory: 2 KB a vertex for 200 pairs, half of it the result. `report` as
/// above.
/// @throws EngineError(cancelled, parametrization_failed)
[[nodiscard]] std::optional<FloatEigenbasis> compute_eigenbasis_by_levels(const TriMesh& mesh, const Laplacian& laplacian, int count,
                                                                          int threads, const Progress& progress,
                                                                          const std::function<void(double)>& report = {},
                                                                          Eigen::Index most_factorized = 150'000);

/// The eigenbasis of a surface of unit area, by the solver that the parameters choose, in the numbering of `mesh`. Where levels
/// do not work out, block Lanczos takes their place. The first pair is exact: zero and a constant. `report` and `threads` as above.
/// @throws EngineError(cancelled, parametrization_failed)
[[nodiscard]] FloatEigenbasis surface_eigenbasis(const TriMesh& mesh, const PreprocessParameters& parameters, int threads,
                                                 const Progress& progress, const std::function<void(double)>& report = {});

}  // namespace spherematch
