// From candidate rotations to the one registration of a pair: optical flow of all, selection of the best.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "engine/data/parameters.h"
#include "engine/data/progress.h"
#include "engine/register/elastic_flow.h"
#include "engine/register/flow_side.h"
#include "engine/register/hints.h"
#include "engine/register/match_shape.h"
#include "engine/register/node_map.h"

namespace spherematch {

/// One shape of a pair, and what the parameters ask of it. Refers to the shape, which must outlive it.
struct PairSide {
  const MatchShape& shape;
  std::vector<Eigen::Index> flow_channels;       ///< of shape.signals(), one per flow time, then the heat details
  std::vector<Eigen::Index> selection_channels;  ///< of shape.signals(): what registrations are compared by
  std::optional<ElasticChannels> elastic;        ///< where an elastic flow is wanted
  std::shared_ptr<const MeshSignals> mesh;       ///< where the flow moves meshes, else null

  /// @throws EngineError(invalid_parameter) when a time is none of those at which the shape's signals are stored
  PairSide(const MatchShape& match_shape, const MatchParameters& parameters);
};

/// What is registered. Refers to its members, which must outlive it.
struct Pair {
  const PairSide& source;
  const PairSide& target;
  const HintDirections& hints;
  const MatchParameters& parameters;
};

/// One candidate on its way through the flow. Refers to the sides of its pair.
struct Registration {
  std::size_t candidate;  ///< index of its rotation
  bool guided;            ///< pulled together at the hints before the flow
  std::unique_ptr<FlowSide> source, target;
  double cost = 0;                  ///< of the signals' differences after the optical flow
  double score = 0;                 ///< lowest for the best
  std::optional<NodeMap> map = {};  ///< since the elastic flow
  double strain = 0;                ///< mean of squares, of the last level of the elastic flow
};

/// Every rotation's registration before the flow; with hints once as it is and once guided by them.
[[nodiscard]] std::vector<Registration> start_registrations(const Pair& pair, const std::vector<Eigen::Matrix3d>& rotations);

/// Flows the registrations, all of them through the coarse levels and the most promising ones through the others and the first level of the
/// elastic flow, and scores them. Returns the indices of the latter, best first. Uses up to `threads` threads.
/// @throws EngineError(cancelled)
[[nodiscard]] std::vector<std::size_t> flow_candidates(std::vector<Registration>& registrations, const Pair& pair, const Progress& progress,
                                                       int threads);

/// Takes one of these through the rest of the elastic flow, after which it has its final map.
/// @throws EngineError(cancelled)
void refine(const Pair& pair, Registration& registration, const Progress& progress, int threads);

}  // namespace spherematch
