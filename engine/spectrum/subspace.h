// A subspace of functions that is drawn towards the lowest eigenvectors. Internal to engine/spectrum.
#pragma once

#include <Eigen/Core>

#include "engine/spectrum/pencil.h"
#include "engine/spectrum/shift_inverse.h"
#include "engine/spectrum/work_meter.h"

namespace spherematch {

/// Columns are approximate eigenvectors, `values` their approximate eigenvalues, ascending. The number of columns is a multiple of
/// FloatShiftInverse::width.
struct Subspace {
  FloatBlock vectors;
  Eigen::VectorXd values;
};

// Each function below works through all values of the subspace, says so in rows to the meter, and throws EngineError(cancelled).
// Each uses up to `threads` threads; the bytes do not depend on their number.

/// Applies (S - sigma M)^-1 M to each column, and scales it so that an eigenvector would stay what it is.
void iterate_inversely(Subspace& subspace, const Pencil& pencil, const FloatShiftInverse& inverse, double sigma, int threads,
                       WorkMeter& meter);

/// Lessens S x - lambda M x of each column, for its own lambda, by `steps` steps of Chebyshev's iteration with the diagonal of S as
/// preconditioner: what oscillates goes, down to frequencies of `part` of the highest. Cheaper than the inverse where a factor is large.
void smooth(Subspace& subspace, const Pencil& pencil, int steps, double part, int threads, WorkMeter& meter);

/// Makes the columns orthonormal in the mass inner product, each by those before it, up to single precision.
/// False, and the subspace is as it was, when its columns are linearly dependent.
[[nodiscard]] bool orthonormalize(Subspace& subspace, const Pencil& pencil, int threads, WorkMeter& meter);

/// Rayleigh-Ritz: the eigenpairs of the problem restricted to the subspace take the place of its columns, orthonormal as above.
/// False, and the subspace is as it was, when its columns are linearly dependent.
[[nodiscard]] bool project(Subspace& subspace, const Pencil& pencil, int threads, WorkMeter& meter);

/// Of each column x with value lambda: the norm of S x - lambda M x in the inverse of the lumped mass. Up to lumping, some eigenvalue
/// is no farther from lambda.
[[nodiscard]] Eigen::VectorXd residuals(const Subspace& subspace, const Pencil& pencil, int threads, WorkMeter& meter);

}  // namespace spherematch
