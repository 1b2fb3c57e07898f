// Authalic evolution: the parametrisation flows away from where surface area concentrates (Zou et al. 2011; paper 3.2, 4.1).
#pragma once

#include <Eigen/Core>
#include <functional>

#include "engine/data/parameters.h"
#include "engine/data/progress.h"
#include "engine/data/tri_mesh.h"

namespace spherematch {

/// Advects the vertices along -grad log(area scale factor), sampled or exactly rasterised and its logarithm smoothed for time
/// authalic_smoothing, and recentres after each step. No triangle of the result is flipped: each step is projected back by FlipRepair.
/// `report` is called with the fraction done.
/// @throws EngineError(cancelled)
void evolve_authalically(Points& sphere, const TriMesh& surface, const PreprocessParameters& parameters, const Progress& progress,
                         const std::function<void(double)>& report);

}  // namespace spherematch
