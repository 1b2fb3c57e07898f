// The cost of a registration, by which one candidate rotation is chosen (paper section 4.4, "Rotation candidate selection").
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/data/tri_mesh.h"
#include "engine/sphere/grid_samples.h"

namespace spherematch {

/// A shape's signals as they lie on the registered sphere: row i of the origins (N * N, 3) is the point of the prepared sphere that is
/// registered at cell centre i of a grid (engine/register/flow_side.h). Refers to its members, which must outlive it.
struct RegisteredSignals {
  const GridSamples& signals;
  const std::vector<Eigen::Index>& channels;  ///< those that are compared
  const Points& origins;
};

/// Root of the mean square difference of two shapes' signals over the sphere and over the channels, which have the given weights. Squares
/// tell better than absolute values: a map that is turned round is wrong by much at feet, hands and face, which are small.
[[nodiscard]] double registration_cost(const RegisteredSignals& source, const RegisteredSignals& target, const std::vector<double>& weights,
                                       int resolution);

/// The paper's cost: mean over the sphere, and over the channels, of the absolute difference of signals that are smoothed before.
[[nodiscard]] double paper_cost(const RegisteredSignals& source, const RegisteredSignals& target, int resolution);

}  // namespace spherematch
