#include "engine/register/candidate_flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include "engine/data/parallel.h"
#include "engine/register/optical_flow.h"
#include "engine/register/rotation.h"
#include "engine/register/selection.h"
#include "engine/spectrum/curvature.h"
#include "engine/spectrum/signatures.h"

namespace spherematch {
namespace {

/// Of the hints' distance beside the signals' cost, of which candidates differ by a few hundredths, after the optical flow; and after the
/// elastic flow, which draws hints together in wrong registrations too, so that there the strain tells more.
constexpr double kHintWeight = 0.4, kDrawnHintWeight = 0.1;
/// Widths of the guiding deformation in radians: wide before the coarse levels, for proportions that differ, then narrower.
constexpr double kCoarseGuide = 1.2, kFineGuide = 0.5;

/// Of the curvature signal among the selection signals, where a shape is matched with its own mirror image. There a map that turns every
/// limb back to front, onto itself, is helped by the signals of the metric, which are exactly equal, while the right one takes a limb to
/// another in another pose. Between different shapes backs and chests differ too much to be compared.
constexpr double kCurvatureWeight = 0.15;

/// Of the mean square of strains, by whose power the signals' cost is multiplied. Not where a shape is matched with its mirror image:
/// curvature then tells more, and limbs turned back to front are strained little.
constexpr double kStrainExponent = 0.25;

constexpr int kNodes = 64;  ///< resolution of the grid on which registrations are followed and compared

std::unique_ptr<FlowSide> flow_side(const PairSide& side, const Eigen::Matrix3d& rotation) {
  if (side.mesh) return std::make_unique<MeshFlowSide>(side.mesh, rotation);
  return std::make_unique<GridFlowSide>(side.shape.signals(), side.flow_channels, rotation, kNodes);
}

/// Rotation and flow are split evenly, so that exchanging the shapes gives the inverse map.
Registration rotated(const Pair& pair, std::size_t candidate, const Eigen::Matrix3d& rotation, bool guided) {
  const Eigen::Matrix3d half = half_rotation(rotation);
  return {candidate, guided, flow_side(pair.source, half), flow_side(pair.target, half.transpose())};
}

/// The hierarchy's levels `first` to `last` - 1.
FlowParameters flow_levels(const MatchParameters& parameters, std::size_t first, std::size_t last) {
  FlowParameters flow;
  flow.smoothness = parameters.flow_smoothness;
  flow.tolerance = parameters.flow_tolerance;
  flow.settled = parameters.flow_settled;
  flow.finest_resolution = parameters.finest_flow;
  for (std::size_t level = first; level < last; ++level) {
    FlowLevel added{parameters.flow_resolution << level, parameters.flow_iterations, {level}, {1}};
    if (parameters.flow_detail > 0 && static_cast<int>(level) >= parameters.flow_detail_from) {
      for (std::size_t c = 0; c < heat_detail_names().size(); ++c) {
        added.channels.push_back(parameters.flow_times.size() + c);
        added.weights.push_back(parameters.flow_detail);
      }
    }
    flow.levels.push_back(std::move(added));
  }
  return flow;
}

/// Where there is no elastic flow the map has as many nodes as it can.
constexpr std::size_t kFinestNodes = 2;

/// Icospheres of 2562, 10242, 40962 nodes, each made at most once in a process: a table of 10242 takes 15 ms.
const NodeMesh& node_mesh(std::size_t level) {
  if (level == 0) {
    static const NodeMesh coarse(4);
    return coarse;
  }
  if (level == 1) {
    static const NodeMesh middle(5);
    return middle;
  }
  static const NodeMesh fine(6);
  return fine;
}

ElasticParameters elastic_level(const MatchParameters& parameters, std::size_t level) {
  return {.area = parameters.elastic_area,
          .yield = parameters.elastic_yield,
          .signals = parameters.elastic_signals,
          .signal_yield = parameters.elastic_signal_yield,
          .spectrum = parameters.elastic_spectrum,
          .eigenfunctions = parameters.elastic_eigenfunctions,
          .more_eigenfunctions = parameters.elastic_more_eigenfunctions,
          .longest_move = parameters.elastic_longest_move,
          .settled = parameters.elastic_settled,
          .iterations = parameters.elastic_iterations[level]};
}

/// Mean distance of the hints where both shapes are registered, relative to the square root of the sphere's area.
double hint_distance(const Points& source, const Points& target) {
  return (source - target).rowwise().norm().mean() / std::sqrt(4 * std::numbers::pi);
}

bool is_symmetry(const Pair& pair) { return &pair.source.shape.shape() == &pair.target.shape.shape(); }

/// Of the channels of PairSide::selection_channels.
std::vector<double> selection_weights(const Pair& pair) {
  std::vector<double> weights = selection_signal_weights();
  weights.push_back(is_symmetry(pair) ? kCurvatureWeight : 0);
  return weights;
}

/// After the optical flow.
void judge_by_signals(Registration& registration, const Pair& pair, int nodes) {
  const Points s = registration.source->origins(nodes), t = registration.target->origins(nodes);
  const RegisteredSignals f{pair.source.shape.signals(), pair.source.selection_channels, s};
  const RegisteredSignals g{pair.target.shape.signals(), pair.target.selection_channels, t};
  registration.cost = pair.parameters.paper_selection ? paper_cost(f, g, nodes) : registration_cost(f, g, selection_weights(pair), nodes);
  registration.score = registration.cost;
  if (pair.hints.source.rows() == 0) return;
  const Points from = registration.source->warp().forward(pair.hints.source), to = registration.target->warp().forward(pair.hints.target);
  registration.score += kHintWeight * hint_distance(from, to);
}

/// After the elastic flow too. It fits the signals of a wrong registration nearly as well as those of the right one, but strains the
/// surfaces more to do so: then the strain tells, and what the signals cost before it.
void judge_by_strain(Registration& registration, const Pair& pair) {
  registration.score = registration.cost;
  if (!is_symmetry(pair)) registration.score *= std::pow(registration.strain, kStrainExponent);
  if (pair.hints.source.rows() > 0)
    registration.score += kDrawnHintWeight * hint_distance(registration.map->forward(pair.hints.source), pair.hints.target);
}

/// One level of the elastic flow.
void relax(Registration& registration, const Pair& pair, std::size_t level, const Progress& progress, int threads) {
  NodeMap map(node_mesh(level), *registration.source, *registration.target);
  if (registration.map) map.follow(*registration.map);
  registration.strain = flow_elastically(map, *pair.source.elastic, *pair.target.elastic, pair.hints, elastic_level(pair.parameters, level),
                                         progress, threads);
  registration.map.emplace(std::move(map));
}

}  // namespace

PairSide::PairSide(const MatchShape& match_shape, const MatchParameters& parameters) : shape(match_shape) {
  for (const double time : parameters.flow_times) flow_channels.push_back(shape.channel(hks_name(time)));
  if (parameters.flow_detail > 0)
    for (const std::string& name : heat_detail_names()) flow_channels.push_back(shape.channel(name));
  if (parameters.paper_selection) {
    selection_channels = {shape.channel(hks_name(0.01))};
  } else {
    for (const std::string& name : selection_signal_names()) selection_channels.push_back(shape.channel(name));
    selection_channels.push_back(shape.channel(curvature_signal_name));
  }
  if (!parameters.elastic_iterations.empty()) {
    elastic.emplace(ElasticChannels{shape.signals(), {}, {}, selection_signal_weights(), {}});
    for (std::size_t axis = 0; axis < 3; ++axis) elastic->position[axis] = shape.channel(position_signal_names[axis]);
    for (const std::string& name : selection_signal_names()) elastic->compared.push_back(shape.channel(name));
    elastic->eigenfunctions = shape.eigenfunctions();
  }
  if (parameters.mesh_flow) mesh = std::make_shared<const MeshSignals>(shape, parameters.flow_times);
}

std::vector<Registration> start_registrations(const Pair& pair, const std::vector<Eigen::Matrix3d>& rotations) {
  std::vector<Registration> registrations;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    registrations.push_back(rotated(pair, i, rotations[i], false));
    if (pair.hints.source.rows() > 0) registrations.push_back(rotated(pair, i, rotations[i], true));
  }
  return registrations;
}

std::vector<std::size_t> flow_candidates(std::vector<Registration>& registrations, const Pair& pair, const Progress& progress,
                                         int threads) {
  const bool hinted = pair.hints.source.rows() > 0;
  std::vector<std::size_t> order(registrations.size());
  std::iota(order.begin(), order.end(), 0);
  const auto better = [&](std::size_t i, std::size_t j) { return registrations[i].score < registrations[j].score; };
  const auto flow = [&](std::size_t first, std::size_t last) {
    const FlowPlan plan(flow_levels(pair.parameters, first, last), kNodes);
    run_parallel(order.size(), threads, [&](std::size_t i) {
      Registration& registration = registrations[order[i]];
      if (registration.guided)
        pull_together(*registration.source, *registration.target, pair.hints, first == 0 ? kCoarseGuide : kFineGuide);
      flow_together(*registration.source, *registration.target, plan, progress);
      judge_by_signals(registration, pair, plan.nodes());
    });
    std::stable_sort(order.begin(), order.end(), better);
  };

  const std::size_t levels = pair.parameters.flow_times.size(), coarse = levels / 2;
  // One more with hints: the best may be there guided and unguided.
  const std::size_t fine = static_cast<std::size_t>(pair.parameters.fine_candidates) + (hinted ? 1 : 0);
  flow(0, coarse);
  order.resize(std::min(fine, order.size()));
  // Large differences of pose are not made up for in the iterations of a level. More of them for all candidates would fit wrong ones
  // better.
  flow(coarse - std::min(coarse, static_cast<std::size_t>(pair.parameters.flow_repeated)), levels);

  if (!pair.parameters.elastic_iterations.empty()) {
    const int threads_each = std::max(1, threads / static_cast<int>(order.size()));
    run_parallel(order.size(), threads, [&](std::size_t i) {
      Registration& registration = registrations[order[i]];
      relax(registration, pair, 0, progress, threads_each);
      judge_by_strain(registration, pair);
    });
    std::stable_sort(order.begin(), order.end(), better);
  }
  return order;
}

void refine(const Pair& pair, Registration& registration, const Progress& progress, int threads) {
  for (std::size_t level = 1; level < pair.parameters.elastic_iterations.size(); ++level)
    relax(registration, pair, level, progress, threads);
  if (!registration.map) registration.map.emplace(node_mesh(kFinestNodes), *registration.source, *registration.target);
}

}  // namespace spherematch
