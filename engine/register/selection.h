// The cost of a registration, by which one candidate rotation is chosen (paper section 4.4, "Rotation candidate selection").
#pragma once

#include <Eigen/Core>

#include "engine/data/tri_mesh.h"
#include "engine/sphere/grid_samples.h"

namespace spherematch {

/// Mean over the sphere, and over the channels, of the absolute difference of two shapes' signals. Row i of the origins (N * N, 3) is
/// the point of the prepared sphere that is registered at cell centre i of a grid (engine/register/flow_side.h).
[[nodiscard]] double registration_cost(const GridSamples& source_signals, const Points& source_origins, const GridSamples& target_signals,
                                       const Points& target_origins, int resolution);

/// The paper's cost: the same for one signal, smoothed before it is compared.
[[nodiscard]] double paper_cost(const GridSamples& source_signal, const Points& source_origins, const GridSamples& target_signal,
                                const Points& target_origins, int resolution);

}  // namespace spherematch
