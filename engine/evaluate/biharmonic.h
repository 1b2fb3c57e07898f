// Biharmonic distances (Lipman, Rustamov & Funkhouser 2010), as the paper measures its maps (section 5.1).
#pragma once

#include <span>
#include <vector>

#include "engine/data/preprocessed_shape.h"
#include "engine/data/progress.h"
#include "engine/evaluate/surface_distance.h"

namespace spherematch {

/// sqrt(sum_i (phi_i(p) - phi_i(q))^2 / lambda_i^2) between p = from[i] and q = to[i], over the non-constant eigenpairs of the shape, of
/// the surface at unit area. Eigenvectors are interpolated with the weights of a point. `shape` has its eigenbasis.
/// Takes time in proportion to points and eigenpairs. Thread-safe. @throws EngineError(cancelled)
[[nodiscard]] std::vector<double> biharmonic_distances(const PreprocessedShape& shape, std::span<const PlacedPoint> from,
                                                       std::span<const PlacedPoint> to, const Progress& progress);

}  // namespace spherematch
