// Divergence-free optical flow between two rotationally aligned spherical parametrisations (paper section 4.4).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/data/progress.h"
#include "engine/register/flow_side.h"

namespace spherematch {

/// One level of the hierarchy: signals on an N x N grid, harmonics up to N / 2.
struct FlowLevel {
  int resolution;
  int iterations;
  std::vector<Eigen::Index> channels;  ///< of the sides' signals: what drives this level
};

struct FlowParameters {
  std::vector<FlowLevel> levels;
  double smoothness = 0.05;  ///< alpha
};

/// Moves both shapes half way towards each other, level by level. Each iteration minimises, over tangent fields W = p x grad u,
///   sum over channels and both shapes of (<grad f_i, W> - (f_S - f_T))^2 + alpha (Laplacian u)^2
/// in spherical harmonics (no poles) by conjugate gradients, smooths u, and moves the source by W/2 and the target by -W/2.
/// @throws EngineError(cancelled)
void flow_together(FlowSide& source, FlowSide& target, const FlowParameters& parameters, const Progress& progress);

}  // namespace spherematch
