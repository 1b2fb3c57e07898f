#include "engine/register/candidate_flow.h"

#include <algorithm>
#include <numeric>

#include "engine/data/parallel.h"
#include "engine/register/composition.h"
#include "engine/register/rotation.h"
#include "engine/register/selection.h"

namespace spherematch {
namespace {

/// The signals' scores of candidates differ by a few thousandths, so hints decide where they differ by a few hundredths of the shape.
constexpr double kHintWeight = 0.1;
/// Widths of the guiding deformation in radians: wide before the coarse levels, for proportions that differ, then narrower.
constexpr double kCoarseGuide = 1.2, kFineGuide = 0.5;

/// Rotation and flow are split evenly, so that exchanging the shapes gives the inverse map.
Registration rotated(const Pair& pair, std::size_t candidate, const Eigen::Matrix3d& rotation, bool guided) {
  const Eigen::Matrix3d half = half_rotation(rotation);
  return {.candidate = candidate,
          .guided = guided,
          .source = {&pair.source.mesh.faces, &pair.source.signals.flow, &pair.source.repair, pair.source.sphere * half.transpose()},
          .target = {&pair.target.mesh.faces, &pair.target.signals.flow, &pair.target.repair, pair.target.sphere * half}};
}

void guide(Registration& registration, const std::vector<PlacedHint>& hints, double width) {
  pull_together(registration.source.sphere, registration.target.sphere, hints, width);
  // What repair cannot mend now, it may mend after the flow.
  (void)registration.source.repair->repair(registration.source.sphere);
  (void)registration.target.repair->repair(registration.target.sphere);
}

/// The hierarchy's levels `first` to `last` - 1.
FlowParameters flow_levels(const MatchParameters& parameters, std::size_t first, std::size_t last) {
  FlowParameters flow;
  flow.smoothness = parameters.flow_smoothness;
  for (std::size_t level = first; level < last; ++level)
    flow.levels.push_back({parameters.flow_resolution << level, parameters.flow_iterations, {static_cast<Eigen::Index>(level)}});
  return flow;
}

void judge_signals(Registration& registration, const Pair& pair) {
  const Points &s = registration.source.sphere, &t = registration.target.sphere;
  const Triangles &source = pair.source.mesh.faces, &target = pair.target.mesh.faces;
  const SideSignals &f = pair.source.signals, &g = pair.target.signals;
  registration.locations = locate_all(s, PointLocation(t, target));
  if (pair.parameters.paper_selection) {
    registration.score = paper_cost(s, source, f.selection, t, target, g.selection, 128);
    return;
  }
  registration.back = locate_back(registration);
  registration.score = 0.5 * (registration_cost(f.selection, f.weights, g.selection, target, registration.locations) +
                              registration_cost(g.selection, g.weights, f.selection, source, registration.back));
}

void judge(Registration& registration, const Pair& pair) {
  judge_signals(registration, pair);
  if (pair.hints.empty()) return;
  const double there = hint_distance(pair.hints, pair.target.mesh, registration.locations);
  const double back = registration.back.empty() ? there : hint_distance(exchanged(pair.hints), pair.source.mesh, registration.back);
  registration.score += kHintWeight * 0.5 * (there + back);
}

}  // namespace

std::vector<Registration> start_registrations(const Pair& pair, const std::vector<Eigen::Matrix3d>& rotations) {
  std::vector<Registration> registrations;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    registrations.push_back(rotated(pair, i, rotations[i], false));
    if (!pair.hints.empty()) registrations.push_back(rotated(pair, i, rotations[i], true));
  }
  return registrations;
}

std::size_t flow_candidates(std::vector<Registration>& registrations, const Pair& pair, const Progress& progress, int threads) {
  std::vector<std::size_t> order(registrations.size());
  std::iota(order.begin(), order.end(), 0);
  const auto better = [&](std::size_t i, std::size_t j) { return registrations[i].score < registrations[j].score; };
  const auto flow = [&](std::size_t first, std::size_t last) {
    run_parallel(order.size(), threads, [&](std::size_t i) {
      Registration& registration = registrations[order[i]];
      if (registration.guided) guide(registration, pair.hints, first == 0 ? kCoarseGuide : kFineGuide);
      flow_together(registration.source, registration.target, flow_levels(pair.parameters, first, last), progress);
      judge(registration, pair);
    });
    std::stable_sort(order.begin(), order.end(), better);
  };

  const std::size_t levels = pair.parameters.flow_times.size();
  // One more with hints: the best may be there guided and unguided.
  const std::size_t fine = static_cast<std::size_t>(pair.parameters.fine_candidates) + (pair.hints.empty() ? 0 : 1);
  std::size_t coarse = 0;
  if (order.size() > fine || !pair.hints.empty()) {
    coarse = levels / 2;
    flow(0, coarse);
    order.resize(std::min(fine, order.size()));
  }
  flow(coarse, levels);
  return order.front();
}

std::vector<Location> locate_back(const Registration& registration) {
  return locate_all(registration.target.sphere, PointLocation(registration.source.sphere, *registration.source.faces));
}

}  // namespace spherematch
