// Elastic flow: what the optical flow, which knows only the sphere, leaves to be done on the surfaces themselves.
// Our own addition to the paper. Strain of the surfaces' own triangles as the measure of smoothness is known from cortical registration
// (Robinson et al. 2018).
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/data/progress.h"
#include "engine/register/hints.h"
#include "engine/register/node_map.h"
#include "engine/sphere/grid_samples.h"

namespace spherematch {

struct ElasticParameters {
  double area = 1;            ///< weight of changes of area, against that of losses of shape
  double yield = 1;           ///< strain from which a triangle resists less and less
  double signals = 20;        ///< weight of differences of signals
  double longest_move = 0.1;  ///< radians, of a node in a step
  double settled = 0.005;     ///< radians: ends with the first step that would move no node farther
  int iterations = 6;         ///< at most
};

/// What is read of a shape.
struct ElasticChannels {
  const GridSamples& samples;            ///< on the prepared sphere
  std::array<Eigen::Index, 3> position;  ///< of the surface of unit area
  std::vector<Eigen::Index> compared;    ///< signals
  std::vector<double> weights;           ///< of these
};

/// Mean over both surfaces.
struct ElasticEnergy {
  double strain = 0;   ///< of the squares of strains, weighted
  double signals = 0;  ///< of the squares of differences, with the weights of the channels
};

/// Moves the nodes, in turn on the target sphere and on the source sphere, so that
///   integral of area (log s + log t)^2 + (log s - log t)^2 + signals sum_c w_c (f_S,c - f_T,c)^2
/// falls, where s and t are the singular values of the map from surface to surface: by Gauss-Newton steps over tangent vectors at the
/// nodes, whose triangles stand for the surfaces. Strains above `yield` count less than by their square: on limbs narrower than a triangle
/// they say little. Unlike the optical flow's these steps change areas on the sphere where that spares strain on the surfaces. A step that
/// would turn triangles over is shortened round these. Hints, of which there may be none, draw their points together. Returns the energy
/// before the last step. Uses up to `threads` threads.
/// @throws EngineError(cancelled)
ElasticEnergy flow_elastically(NodeMap& map, const ElasticChannels& source, const ElasticChannels& target, const HintDirections& hints,
                               const ElasticParameters& parameters, const Progress& progress, int threads);

}  // namespace spherematch
