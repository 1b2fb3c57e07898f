// The eigenproblem of a surface on ever coarser meshes. Internal to engine/spectrum.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "engine/data/progress.h"
#include "engine/data/tri_mesh.h"
#include "engine/mesh/laplacian.h"

namespace spherematch {

using Interpolation = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A coarse level: the stiffness and mass of the functions that are linear on the coarse mesh, taken to the finer one. They are the
/// Galerkin products P^T S P and P^T M P, so the geometry stays that of the finest mesh and eigenvalues are bounds from above.
struct CoarseLevel {
  Laplacian laplacian;          ///< lower triangles, both of one pattern
  Interpolation interpolation;  ///< P, (finer V, V), at most three entries a row
};

/// From fine to coarse, each level about `ratio` times smaller, until one has at most `coarsest` vertices; fewer levels, or none,
/// where the mesh cannot be coarsened. `laplacian` is of the mesh's vertices.
/// @throws EngineError(cancelled)
[[nodiscard]] std::vector<CoarseLevel> coarse_levels(const TriMesh& mesh, const Laplacian& laplacian, Eigen::Index coarsest, double ratio,
                                                     const Progress& progress);

/// P^T S P and P^T M P, lower triangles of one pattern, of matrices that are so too.
/// @throws EngineError(cancelled)
[[nodiscard]] Laplacian galerkin_product(const Laplacian& laplacian, const Interpolation& interpolation, const Progress& progress);

}  // namespace spherematch
