// Divergence-free optical flow between two rotationally aligned spherical parametrisations (paper section 4.4).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/data/progress.h"
#include "engine/register/flow_side.h"

namespace spherematch {

/// One level of the hierarchy.
struct FlowLevel {
  int resolution;                     ///< N: signals and fields are smoothed as suits harmonics up to N / 2
  int iterations;                     ///< at most
  std::vector<std::size_t> channels;  ///< of the sides' signals: what drives this level
  std::vector<double> weights = {};   ///< of the channels; empty where they weigh alike
};

struct FlowParameters {
  std::vector<FlowLevel> levels;
  double smoothness = 0.05;     ///< alpha
  double tolerance = 1e-5;      ///< of the conjugate gradients: the residual, against the one at the start
  double settled = 0;           ///< radians: a level ends with the first step that moves no point farther
  int finest_resolution = 128;  ///< levels above it are solved on a grid of this resolution
};

/// Some levels of the hierarchy with their transforms, for any number of pairs. Immutable, thread-safe.
class FlowPlan {
 public:
  /// The sides are followed at the nodes of a grid of the resolution `nodes`, or of the finest that is solved on where that is finer.
  FlowPlan(FlowParameters parameters, int nodes);

  struct Level {
    FlowLevel level;
    HarmonicTransform on_level;  ///< solves
    HarmonicTransform on_nodes;  ///< of the same degree: reads signals, writes fields
  };
  [[nodiscard]] const std::vector<Level>& levels() const { return levels_; }
  [[nodiscard]] double smoothness() const { return smoothness_; }
  [[nodiscard]] double tolerance() const { return tolerance_; }
  [[nodiscard]] double settled() const { return settled_; }
  [[nodiscard]] int nodes() const { return nodes_; }

 private:
  double smoothness_;
  double tolerance_;
  double settled_;
  int nodes_;
  std::vector<Level> levels_;
};

/// Moves both shapes half way towards each other, level by level. Each iteration minimises, over tangent fields W = p x grad u,
///   weighted sum over channels and both shapes of (<grad f_i, W> - (f_S - f_T))^2 + alpha (Laplacian u)^2
/// in spherical harmonics (no poles) by conjugate gradients, smooths u, and moves the source by W/2 and the target by -W/2.
/// @throws EngineError(cancelled)
void flow_together(FlowSide& source, FlowSide& target, const FlowPlan& plan, const Progress& progress);

}  // namespace spherematch
