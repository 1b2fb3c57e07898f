// Conformal parametrisation over the sphere by conformalised mean curvature flow (Kazhdan, Solomon, Ben-Chen 2012; paper 3.1).
#pragma once

#include <functional>

#include "engine/data/parameters.h"
#include "engine/data/progress.h"
#include "engine/data/tri_mesh.h"

namespace spherematch {

/// Evolves the surface to a sphere: (M_t + d S_0) x_{t+1} = M_t x_t with the stiffness of the input frozen, scaled to unit area
/// and centred after each step, then projected radially and freed of flipped triangles.
/// A surface of clearly more than conformal_coarse_vertices flows as a copy of so many, and a few steps of its own follow. Where the
/// result is not valid the flow of the surface itself, more passes, fewer steps and the mere radial projection, which is not conformal,
/// are tried in turn.
/// Where the map has collapsed a limb below collapse_threshold, collapse_passes extra passes open it up. `report` is called with the
/// fraction done.
/// @return (V, 3) unit vectors without a flipped triangle
/// @throws EngineError(cancelled, parametrization_failed)
[[nodiscard]] Points conformal_parametrization(const TriMesh& surface, const PreprocessParameters& parameters, const Progress& progress,
                                               const std::function<void(double)>& report = {});

}  // namespace spherematch
