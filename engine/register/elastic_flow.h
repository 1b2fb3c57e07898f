// Elastic flow: what the optical flow, which knows only the sphere, leaves to be done on the surfaces themselves.
// Our own addition to the paper. Strain of the surfaces' own triangles as the measure of smoothness is known from cortical registration
// (Robinson et al. 2018).
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/data/progress.h"
#include "engine/register/elastic_system.h"
#include "engine/register/hints.h"
#include "engine/register/node_map.h"
#include "engine/sphere/grid_samples.h"

namespace spherematch {

struct ElasticParameters {
  double area = 1;              ///< weight of changes of area, against that of losses of shape
  double yield = 1;             ///< strain from which a triangle resists less and less
  double signals = 25;          ///< weight of differences of signals
  double signal_yield = 0.5;    ///< multiple of their mean square from which they count less and less
  double spectrum = 5;          ///< weight of differences of eigenfunctions, zero for none
  int eigenfunctions = 20;      ///< of the lowest frequencies, compared in the first step
  int more_eigenfunctions = 5;  ///< in each further one
  double longest_move = 0.1;    ///< radians, of a node in a step
  double settled = 0.005;       ///< radians: ends with the first step that would move no node farther
  int iterations = 6;           ///< at most
};

/// What is read of a shape.
struct ElasticChannels {
  const GridSamples& samples;                ///< on the prepared sphere
  std::array<Eigen::Index, 3> position;      ///< of the surface of unit area
  std::vector<Eigen::Index> compared;        ///< signals
  std::vector<double> weights;               ///< of these
  std::vector<Eigen::Index> eigenfunctions;  ///< by rising frequency, without the constant
};

/// Moves the nodes, in turn on the target sphere and on the source sphere, so that
///   integral of area (log s + log t)^2 + (log s - log t)^2 + signals sum_c w_c (f_S,c - f_T,c)^2
///               + spectrum mean_j e_j (phi_T,j - sum_i C_ij phi_S,i)^2
/// falls, where s and t are the singular values of the map from surface to surface and C is its functional map on the lowest
/// eigenfunctions phi, of which it explains the shares e: by Gauss-Newton steps over tangent vectors at the nodes, whose triangles stand
/// for the surfaces. Strains above `yield` count less than by their square: on limbs narrower than a triangle they say little; so do
/// large differences of signals. Unlike the optical flow's these steps change areas on the sphere where that spares strain on the surfaces.
/// A step that would turn triangles over is shortened round these. Hints, of which there may be none, draw their points together. Returns
/// the strain before the last step, the mean over both surfaces of the first two terms. Uses up to `threads` threads.
/// @throws EngineError(cancelled)
double flow_elastically(NodeMap& map, const ElasticChannels& source, const ElasticChannels& target, const HintDirections& hints,
                        const ElasticParameters& parameters, const Progress& progress, int threads);

}  // namespace spherematch
