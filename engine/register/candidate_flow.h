// From candidate rotations to the one registration of a pair: optical flow of all, selection of the best.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/data/parameters.h"
#include "engine/data/progress.h"
#include "engine/register/hints.h"
#include "engine/register/optical_flow.h"
#include "engine/register/point_location.h"
#include "engine/register/side.h"

namespace spherematch {

/// What is registered. Refers to its members, which must outlive it.
struct Pair {
  const Side& source;
  const Side& target;
  const std::vector<PlacedHint>& hints;
  const MatchParameters& parameters;
};

/// One candidate on its way through the flow. Refers to the sides of its pair.
struct Registration {
  std::size_t candidate;  ///< index of its rotation
  bool guided;            ///< pulled together at the hints before the flow
  FlowShape source, target;
  std::vector<Location> locations{};  ///< of the source's vertices in the target
  std::vector<Location> back{};       ///< of the target's vertices in the source; empty where the selection needs none
  double score = 0;
};

/// Every rotation's registration before the flow; with hints once as it is and once guided by them.
[[nodiscard]] std::vector<Registration> start_registrations(const Pair& pair, const std::vector<Eigen::Matrix3d>& rotations);

/// Flows the registrations, all of them through the coarse levels and the most promising ones to the end, and scores them. Returns the
/// index of the best. Registrations are independent tasks on up to `threads` threads.
/// @throws EngineError(cancelled)
[[nodiscard]] std::size_t flow_candidates(std::vector<Registration>& registrations, const Pair& pair, const Progress& progress,
                                          int threads);

[[nodiscard]] std::vector<Location> locate_back(const Registration& registration);

}  // namespace spherematch
