// Divergence-free optical flow between two rotationally aligned spherical parametrisations (paper section 4.4).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/data/progress.h"
#include "engine/data/tri_mesh.h"
#include "engine/sphere/flip_repair.h"
#include "engine/sphere/harmonics.h"

namespace spherematch {

/// One level of the hierarchy: signals on an N x N grid, harmonics up to N / 2.
struct FlowLevel {
  int resolution;
  int iterations;
  std::vector<Eigen::Index> channels;  ///< columns of FlowShape::signals that drive this level
};

struct FlowParameters {
  std::vector<FlowLevel> levels;
  double smoothness = 0.05;  ///< alpha
};

/// A shape on its way: the signals stay with the vertices while the flow moves them.
struct FlowShape {
  const Triangles* faces;          ///< (F, 3), not owned
  const Eigen::MatrixXd* signals;  ///< (V, C), not owned
  const FlipRepair* repair;        ///< of the faces, not owned
  Points sphere;                   ///< (V, 3)
};

/// Moves both shapes half way towards each other, level by level. Each iteration minimises, over tangent fields W = p x grad u,
///   sum over channels and both shapes of (<grad f_i, W> - (f_S - f_T))^2 + alpha (Laplacian u)^2
/// in spherical harmonics (no poles) by conjugate gradients, smooths u, and advects the source by W/2 and the target by -W/2.
/// Neither sphere has a flipped face afterwards where repair allows.
/// @throws EngineError(cancelled)
void flow_together(FlowShape& source, FlowShape& target, const FlowParameters& parameters, const Progress& progress);

}  // namespace spherematch
