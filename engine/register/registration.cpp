#include "engine/register/registration.h"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "engine/data/parallel.h"
#include "engine/mesh/laplacian.h"
#include "engine/register/composition.h"
#include "engine/register/optical_flow.h"
#include "engine/register/rotation.h"
#include "engine/register/selection.h"
#include "engine/spectrum/signatures.h"
#include "engine/sphere/flip_repair.h"
#include "engine/sphere/harmonics.h"
#include "engine/sphere/orientation.h"

namespace spherematch {
namespace {

class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// What registration reads of one shape.
struct Side {
  const PreprocessedShape& shape;
  Eigen::MatrixXd flow_signals;
  Eigen::MatrixXd selection;
  Eigen::VectorXd weights;  ///< vertex areas, sum 1
  FlipRepair repair;

  Side(const PreprocessedShape& s, const MatchParameters& parameters)
      : shape(s),
        flow_signals(heat_kernel_signatures(s.eigenvalues, s.eigenvectors, parameters.flow_times)),
        weights(vertex_areas(s.surface.mesh.vertices, s.surface.mesh.faces)),
        repair(s.surface.mesh) {
    weights /= weights.sum();
    selection = parameters.paper_selection ? heat_kernel_signatures(s.eigenvalues, s.eigenvectors, {0.01}) : selection_signals(s);
  }
  [[nodiscard]] const Triangles& faces() const { return shape.surface.mesh.faces; }
};

/// The stored signal that rotations are aligned by.
const Eigen::MatrixXf& rotation_grid(const PreprocessedShape& shape, const MatchParameters& parameters) {
  const std::string name = hks_name(parameters.rotation_time);
  const auto signal = std::find_if(shape.signals.begin(), shape.signals.end(), [&name](const SignalGrid& s) { return s.name == name; });
  if (signal == shape.signals.end())
    throw EngineError(ErrorCode::invalid_parameter, "rotation_time must be one of the times at which the shape's signals are stored");
  return signal->values;
}

std::vector<RotationCandidate> find_candidates(const PreprocessedShape& source, const PreprocessedShape& target,
                                               const MatchParameters& parameters) {
  const Eigen::MatrixXf &s = rotation_grid(source, parameters), &t = rotation_grid(target, parameters);
  const auto finest = static_cast<int>(std::min(s.rows(), t.rows()));
  const int degree = std::min(parameters.rotation_bandwidth, finest / 2) - 1;
  const auto harmonics = [degree](const Eigen::MatrixXf& grid) {
    return HarmonicTransform(static_cast<int>(grid.rows()), degree).analyze(grid.cast<double>().array());
  };
  return align_rotations({harmonics(s)}, {harmonics(t)}, degree, parameters);
}

/// The hierarchy's levels `first` to `last` - 1.
FlowParameters flow_levels(const MatchParameters& parameters, std::size_t first, std::size_t last) {
  FlowParameters flow;
  flow.smoothness = parameters.flow_smoothness;
  for (std::size_t level = first; level < last; ++level)
    flow.levels.push_back({parameters.flow_resolution << level, parameters.flow_iterations, {static_cast<Eigen::Index>(level)}});
  return flow;
}

/// One candidate on its way through the flow.
struct Registration {
  FlowShape source, target;
  std::vector<Location> locations;  ///< of the source's vertices in the target
  std::vector<Location> back;       ///< of the target's vertices in the source
  double score = 0;
};

/// Rotation and flow are split evenly, so that exchanging the shapes gives the inverse map.
Registration rotated(const Side& source, const Side& target, const Eigen::Matrix3d& rotation) {
  const Eigen::Matrix3d half = half_rotation(rotation);
  return {{&source.faces(), &source.flow_signals, &source.repair, source.shape.sphere * half.transpose()},
          {&target.faces(), &target.flow_signals, &target.repair, target.shape.sphere * half},
          {},
          {},
          0};
}

void judge(Registration& registration, const Side& source, const Side& target, const MatchParameters& parameters) {
  const Points &s = registration.source.sphere, &t = registration.target.sphere;
  registration.locations = locate_all(s, PointLocation(t, target.faces()));
  if (parameters.paper_selection) {
    registration.score = paper_cost(s, source.faces(), source.selection, t, target.faces(), target.selection, 128);
    return;
  }
  registration.back = locate_all(t, PointLocation(s, source.faces()));
  registration.score =
      0.5 * (registration_cost(source.selection, source.weights, target.selection, target.faces(), registration.locations) +
             registration_cost(target.selection, target.weights, source.selection, source.faces(), registration.back));
}

/// Flows the candidates: all of them through the coarse levels, the most promising ones to the end. Returns the index of the best.
std::size_t flow_candidates(std::vector<Registration>& registrations, const Side& source, const Side& target,
                            const MatchParameters& parameters, const Progress& progress, int threads) {
  const std::size_t levels = parameters.flow_times.size();
  std::vector<std::size_t> order(registrations.size());
  std::iota(order.begin(), order.end(), 0);
  const auto better = [&](std::size_t i, std::size_t j) { return registrations[i].score < registrations[j].score; };
  const auto flow = [&](std::size_t first, std::size_t last) {
    run_parallel(order.size(), threads, [&](std::size_t i) {
      Registration& registration = registrations[order[i]];
      flow_together(registration.source, registration.target, flow_levels(parameters, first, last), progress);
      judge(registration, source, target, parameters);
    });
    std::stable_sort(order.begin(), order.end(), better);
  };

  std::size_t coarse = 0;
  if (const auto fine = static_cast<std::size_t>(parameters.fine_candidates); order.size() > fine) {
    coarse = levels / 2;
    flow(0, coarse);
    order.resize(fine);
  }
  flow(coarse, levels);
  return order.front();
}

MatchQuality measure_map(const Side& source, const Side& target, const std::vector<Registration>& registrations, std::size_t chosen) {
  double runner_up = 0;
  for (std::size_t i = 0; i < registrations.size(); ++i)
    if (i != chosen && (runner_up == 0 || registrations[i].score < runner_up)) runner_up = registrations[i].score;
  const Registration& best = registrations[chosen];
  return {
      {"flipped_source", static_cast<double>(flipped_faces(best.source.sphere, source.faces()).size())},
      {"flipped_target", static_cast<double>(flipped_faces(best.target.sphere, target.faces()).size())},
      {"score", best.score},
      {"score_runner_up", runner_up},
  };
}

}  // namespace

MatchResult register_pair(const PreprocessedShape& source_shape, const PreprocessedShape& target_shape, const MatchParameters& parameters,
                          const Progress& progress, int threads) {
  const auto report = [&progress](const char* stage, double fraction) {
    if (progress.report) progress.report(stage, fraction);
  };
  Stopwatch total, watch;
  MatchResult result;

  report("rotation", 0);
  const std::vector<RotationCandidate> candidates = find_candidates(source_shape, target_shape, parameters);
  result.seconds.emplace_back("rotation", watch.lap());

  report("flow", 0.1);
  const Side source(source_shape, parameters), target(target_shape, parameters);
  std::vector<Registration> registrations;
  for (const RotationCandidate& candidate : candidates) registrations.push_back(rotated(source, target, candidate.rotation));
  const std::size_t chosen = flow_candidates(registrations, source, target, parameters, progress, threads);
  result.seconds.emplace_back("flow", watch.lap());

  report("correspondence", 0.95);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    CandidateSummary summary;
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(summary.rotation.data()) = candidates[i].rotation;
    summary.correlation = candidates[i].correlation;
    summary.score = registrations[i].score;
    summary.chosen = i == chosen;
    result.candidates.push_back(summary);
  }
  Registration& best = registrations[chosen];
  result.map = compose(source_shape.surface, target_shape.surface, best.locations);
  if (parameters.both) {
    if (best.back.empty()) best.back = locate_all(best.target.sphere, PointLocation(best.source.sphere, source.faces()));
    result.reverse = compose(target_shape.surface, source_shape.surface, best.back);
  }
  result.quality = measure_map(source, target, registrations, chosen);
  result.seconds.emplace_back("correspondence", watch.lap());
  result.seconds.emplace_back("total", total.lap());
  report("correspondence", 1);
  return result;
}

}  // namespace spherematch
