#include "engine/register/candidate_flow.h"

#include <algorithm>
#include <numeric>

#include "engine/data/parallel.h"
#include "engine/register/optical_flow.h"
#include "engine/register/rotation.h"
#include "engine/register/selection.h"

namespace spherematch {
namespace {

/// The signals' scores of candidates differ by a few thousandths, so hints decide where they differ by a few hundredths of the shape.
constexpr double kHintWeight = 0.1;
/// Widths of the guiding deformation in radians: wide before the coarse levels, for proportions that differ, then narrower.
constexpr double kCoarseGuide = 1.2, kFineGuide = 0.5;

/// Resolutions of the grids on which registrations are followed and compared, through the coarse levels and the others.
constexpr int kCoarseNodes = 64, kFineNodes = 64;

std::unique_ptr<FlowSide> flow_side(const Side& side, const Eigen::Matrix3d& rotation, const MatchParameters& parameters) {
  if (parameters.mesh_flow) return std::make_unique<MeshFlowSide>(side.faces, side.vertex_signals, side.sphere, rotation);
  return std::make_unique<GridFlowSide>(side.flow, rotation, kCoarseNodes);
}

/// Rotation and flow are split evenly, so that exchanging the shapes gives the inverse map.
Registration rotated(const Pair& pair, std::size_t candidate, const Eigen::Matrix3d& rotation, bool guided) {
  const Eigen::Matrix3d half = half_rotation(rotation);
  return {candidate, guided, flow_side(pair.source, half, pair.parameters), flow_side(pair.target, half.transpose(), pair.parameters)};
}

/// The hierarchy's levels `first` to `last` - 1.
FlowParameters flow_levels(const MatchParameters& parameters, std::size_t first, std::size_t last) {
  FlowParameters flow;
  flow.smoothness = parameters.flow_smoothness;
  flow.tolerance = parameters.flow_tolerance;
  flow.finest_resolution = parameters.finest_flow;
  for (std::size_t level = first; level < last; ++level)
    flow.levels.push_back({parameters.flow_resolution << level, parameters.flow_iterations, {static_cast<Eigen::Index>(level)}});
  return flow;
}

/// Mean distance of the hints on the sphere where both shapes are registered, relative to the square root of its area.
double hint_distance(const Registration& registration, const HintDirections& hints) {
  const Points s = registration.source->warp().forward(hints.source), t = registration.target->warp().forward(hints.target);
  return (s - t).rowwise().norm().mean() / std::sqrt(4 * std::numbers::pi);
}

void judge(Registration& registration, const Pair& pair, int nodes) {
  const Points s = registration.source->origins(nodes), t = registration.target->origins(nodes);
  const auto& cost = pair.parameters.paper_selection ? paper_cost : registration_cost;
  registration.score = cost(pair.source.selection, s, pair.target.selection, t, nodes);
  if (pair.hints.source.rows() > 0) registration.score += kHintWeight * hint_distance(registration, pair.hints);
}

}  // namespace

std::vector<Registration> start_registrations(const Pair& pair, const std::vector<Eigen::Matrix3d>& rotations) {
  std::vector<Registration> registrations;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    registrations.push_back(rotated(pair, i, rotations[i], false));
    if (pair.hints.source.rows() > 0) registrations.push_back(rotated(pair, i, rotations[i], true));
  }
  return registrations;
}

std::size_t flow_candidates(std::vector<Registration>& registrations, const Pair& pair, const Progress& progress, int threads) {
  const bool hinted = pair.hints.source.rows() > 0;
  std::vector<std::size_t> order(registrations.size());
  std::iota(order.begin(), order.end(), 0);
  const auto better = [&](std::size_t i, std::size_t j) { return registrations[i].score < registrations[j].score; };
  const auto flow = [&](std::size_t first, std::size_t last, int nodes) {
    const FlowPlan plan(flow_levels(pair.parameters, first, last), nodes);
    run_parallel(order.size(), threads, [&](std::size_t i) {
      Registration& registration = registrations[order[i]];
      if (registration.guided)
        pull_together(*registration.source, *registration.target, pair.hints, first == 0 ? kCoarseGuide : kFineGuide);
      flow_together(*registration.source, *registration.target, plan, progress);
      judge(registration, pair, plan.nodes());
    });
    std::stable_sort(order.begin(), order.end(), better);
  };

  const std::size_t levels = pair.parameters.flow_times.size();
  // One more with hints: the best may be there guided and unguided.
  const std::size_t fine = static_cast<std::size_t>(pair.parameters.fine_candidates) + (hinted ? 1 : 0);
  std::size_t coarse = 0;
  if (order.size() > fine || hinted) {
    coarse = levels / 2;
    flow(0, coarse, kCoarseNodes);
    order.resize(std::min(fine, order.size()));
  }
  flow(coarse, levels, kFineNodes);
  return order.front();
}

}  // namespace spherematch
