#include "engine/register/registration.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "engine/data/parallel.h"
#include "engine/mesh/laplacian.h"
#include "engine/register/composition.h"
#include "engine/register/optical_flow.h"
#include "engine/register/rotation.h"
#include "engine/register/selection.h"
#include "engine/spectrum/signatures.h"
#include "engine/sphere/harmonics.h"
#include "engine/sphere/orientation.h"
#include "engine/sphere/rasterizer.h"

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

FlowParameters flow_parameters(const MatchParameters& parameters) {
  FlowParameters flow;
  flow.smoothness = parameters.flow_smoothness;
  int resolution = parameters.flow_resolution;
  for (std::size_t level = 0; level < parameters.flow_times.size(); ++level, resolution *= 2)
    flow.levels.push_back({resolution, parameters.flow_iterations, {static_cast<Eigen::Index>(level)}});
  return flow;
}

struct Registered {
  Points source, target;
  std::vector<Location> locations;
  double score = 0;
};

Registered register_candidate(const Side& source, const Side& target, const Eigen::Matrix3d& rotation, const MatchParameters& parameters,
                              const Progress& progress) {
  // Rotation and flow are split evenly, so that exchanging the shapes gives the inverse map.
  const Eigen::Matrix3d half = half_rotation(rotation);
  FlowShape s{&source.faces(), &source.flow_signals, &source.repair, source.shape.sphere * half.transpose()};
  FlowShape t{&target.faces(), &target.flow_signals, &target.repair, target.shape.sphere * half};
  flow_together(s, t, flow_parameters(parameters), progress);

  Registered result;
  result.locations = locate_all(s.sphere, PointLocation(t.sphere, target.faces()));
  if (parameters.paper_selection) {
    result.score = paper_cost(s.sphere, source.faces(), source.selection, t.sphere, target.faces(), target.selection, 128);
  } else {
    const std::vector<Location> back = locate_all(t.sphere, PointLocation(s.sphere, source.faces()));
    result.score = 0.5 * (registration_cost(source.selection, source.weights, target.selection, target.faces(), result.locations) +
                          registration_cost(target.selection, target.weights, source.selection, source.faces(), back));
  }
  result.source = std::move(s.sphere);
  result.target = std::move(t.sphere);
  return result;
}

MatchQuality measure_map(const Side& source, const Side& target, const Registered& registered, const std::vector<Registered>& all) {
  double runner_up = 0;
  for (const Registered& other : all)
    if (&other != &registered && (runner_up == 0 || other.score < runner_up)) runner_up = other.score;
  return {
      {"flipped_source", static_cast<double>(flipped_faces(registered.source, source.faces()).size())},
      {"flipped_target", static_cast<double>(flipped_faces(registered.target, target.faces()).size())},
      {"score", registered.score},
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
  std::vector<Registered> registered(candidates.size());
  run_parallel(candidates.size(), threads,
               [&](std::size_t i) { registered[i] = register_candidate(source, target, candidates[i].rotation, parameters, progress); });
  result.seconds.emplace_back("flow", watch.lap());

  report("correspondence", 0.95);
  const auto chosen =
      std::min_element(registered.begin(), registered.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    CandidateSummary summary;
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(summary.rotation.data()) = candidates[i].rotation;
    summary.correlation = candidates[i].correlation;
    summary.score = registered[i].score;
    summary.chosen = &registered[i] == &*chosen;
    result.candidates.push_back(summary);
  }
  result.map = compose(source_shape.surface, target_shape.surface, chosen->locations);
  result.quality = measure_map(source, target, *chosen, registered);
  result.seconds.emplace_back("correspondence", watch.lap());
  result.seconds.emplace_back("total", total.lap());
  report("correspondence", 1);
  return result;
}

}  // namespace spherematch
