#include "engine/register/registration.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>

#include "engine/data/parallel.h"
#include "engine/register/composition.h"
#include "engine/register/mirror.h"
#include "engine/register/optical_flow.h"
#include "engine/register/rotation.h"
#include "engine/register/selection.h"
#include "engine/register/side.h"
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

std::vector<RotationCandidate> find_candidates(const PreprocessedShape& source, bool mirrored, const PreprocessedShape& target,
                                               const MatchParameters& parameters) {
  const Eigen::MatrixXf s = rotation_grid(source, parameters, mirrored), t = rotation_grid(target, parameters, false);
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
  return {{&source.mesh.faces, &source.signals.flow, &source.repair, source.sphere * half.transpose()},
          {&target.mesh.faces, &target.signals.flow, &target.repair, target.sphere * half},
          {},
          {},
          0};
}

std::vector<Location> locate_back(const Registration& registration) {
  return locate_all(registration.target.sphere, PointLocation(registration.source.sphere, *registration.source.faces));
}

void judge(Registration& registration, const Side& source, const Side& target, const MatchParameters& parameters) {
  const Points &s = registration.source.sphere, &t = registration.target.sphere;
  const SideSignals &f = source.signals, &g = target.signals;
  registration.locations = locate_all(s, PointLocation(t, target.mesh.faces));
  if (parameters.paper_selection) {
    registration.score = paper_cost(s, source.mesh.faces, f.selection, t, target.mesh.faces, g.selection, 128);
    return;
  }
  registration.back = locate_back(registration);
  registration.score = 0.5 * (registration_cost(f.selection, f.weights, g.selection, target.mesh.faces, registration.locations) +
                              registration_cost(g.selection, g.weights, f.selection, source.mesh.faces, registration.back));
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

/// All that is done with the source as it is, or with its mirror image.
struct Attempt {
  explicit Attempt(bool as_mirror_image) : mirrored(as_mirror_image) {}

  bool mirrored;
  std::vector<RotationCandidate> candidates;
  std::unique_ptr<const Side> source;  ///< stays in place: the registrations refer to it
  std::vector<Registration> registrations;
  std::size_t chosen = 0;

  [[nodiscard]] const Registration& best() const { return registrations[chosen]; }
};

std::vector<Attempt> attempts_for(Orientation orientation) {
  std::vector<Attempt> attempts;
  if (orientation != Orientation::reverse) attempts.emplace_back(false);
  if (orientation != Orientation::preserve) attempts.emplace_back(true);
  return attempts;
}

/// The candidates of all attempts, by falling correlation.
std::vector<CandidateSummary> summarize(const std::vector<Attempt>& attempts, const Attempt& best) {
  std::vector<CandidateSummary> summaries;
  for (const Attempt& attempt : attempts) {
    const Eigen::Matrix3d before = attempt.mirrored ? mirror_matrix() : Eigen::Matrix3d::Identity();
    for (std::size_t i = 0; i < attempt.candidates.size(); ++i) {
      CandidateSummary summary;
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(summary.rotation.data()) = attempt.candidates[i].rotation * before;
      summary.correlation = attempt.candidates[i].correlation;
      summary.score = attempt.registrations[i].score;
      summary.chosen = &attempt == &best && i == attempt.chosen;
      summaries.push_back(summary);
    }
  }
  std::stable_sort(summaries.begin(), summaries.end(), [](const auto& a, const auto& b) { return a.correlation > b.correlation; });
  return summaries;
}

MatchQuality measure_map(const Registration& best, const std::vector<CandidateSummary>& candidates) {
  double runner_up = 0;
  for (const CandidateSummary& candidate : candidates)
    if (!candidate.chosen && (runner_up == 0 || candidate.score < runner_up)) runner_up = candidate.score;
  return {
      {"flipped_source", static_cast<double>(flipped_faces(best.source.sphere, *best.source.faces).size())},
      {"flipped_target", static_cast<double>(flipped_faces(best.target.sphere, *best.target.faces).size())},
      {"score", best.score},
      {"score_runner_up", runner_up},
  };
}

/// The map from target to source; of locations in the faces of the source itself.
Correspondence compose_reverse(const Surface& source, const Surface& target, const Attempt& best) {
  std::vector<Location> back = best.best().back.empty() ? locate_back(best.best()) : best.best().back;
  if (best.mirrored) std::transform(back.begin(), back.end(), back.begin(), mirrored_location);
  return compose(target, source, back);
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
  std::vector<Attempt> attempts = attempts_for(parameters.orientation);
  for (Attempt& attempt : attempts) attempt.candidates = find_candidates(source_shape, attempt.mirrored, target_shape, parameters);
  result.seconds.emplace_back("rotation", watch.lap());

  report("flow", 0.1);
  const SideSignals source_signals(source_shape, parameters), target_signals(target_shape, parameters);
  const Side target(target_shape, target_signals, false);
  for (Attempt& attempt : attempts) {
    attempt.source = std::make_unique<const Side>(source_shape, source_signals, attempt.mirrored);
    for (const RotationCandidate& candidate : attempt.candidates)
      attempt.registrations.push_back(rotated(*attempt.source, target, candidate.rotation));
    attempt.chosen = flow_candidates(attempt.registrations, *attempt.source, target, parameters, progress, threads);
  }
  result.seconds.emplace_back("flow", watch.lap());

  report("correspondence", 0.95);
  const Attempt& best = *std::min_element(attempts.begin(), attempts.end(),
                                          [](const Attempt& a, const Attempt& b) { return a.best().score < b.best().score; });
  result.reversed = best.mirrored;
  result.candidates = summarize(attempts, best);
  result.map = compose(source_shape.surface, target_shape.surface, best.best().locations);
  if (parameters.both) result.reverse = compose_reverse(source_shape.surface, target_shape.surface, best);
  result.quality = measure_map(best.best(), result.candidates);
  result.seconds.emplace_back("correspondence", watch.lap());
  result.seconds.emplace_back("total", total.lap());
  report("correspondence", 1);
  return result;
}

}  // namespace spherematch
