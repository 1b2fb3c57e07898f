#include "engine/register/registration.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

#include "engine/register/candidate_flow.h"
#include "engine/register/composition.h"
#include "engine/register/hints.h"
#include "engine/register/mirror.h"
#include "engine/register/rotation.h"
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

/// The best rotations of the stored signals and, where hints determine one, that of the hints, by falling correlation.
std::vector<RotationCandidate> find_candidates(const PreprocessedShape& source, bool mirrored, const PreprocessedShape& target,
                                               const std::vector<PlacedHint>& hints, const MatchParameters& parameters) {
  const Eigen::MatrixXf s = rotation_grid(source, parameters, mirrored), t = rotation_grid(target, parameters, false);
  const auto finest = static_cast<int>(std::min(s.rows(), t.rows()));
  const int degree = std::min(parameters.rotation_bandwidth, finest / 2) - 1;
  const auto harmonics = [degree](const Eigen::MatrixXf& grid) {
    return HarmonicTransform(static_cast<int>(grid.rows()), degree).analyze(grid.cast<double>().array());
  };
  const std::vector<Harmonics> f{harmonics(s)}, g{harmonics(t)};
  std::vector<RotationCandidate> candidates = align_rotations(f, g, degree, parameters);
  if (const auto hinted = rotation_from_hints(mirrored ? mirrored_points(source.sphere) : source.sphere, target.sphere, hints)) {
    const RotationCandidate extra{*hinted, rotation_correlation(f, g, degree, *hinted)};
    const auto better = [](const RotationCandidate& a, const RotationCandidate& b) { return a.correlation > b.correlation; };
    candidates.insert(std::upper_bound(candidates.begin(), candidates.end(), extra, better), extra);
  }
  return candidates;
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

/// A rotation with the score of its chosen registration, else of its best.
CandidateSummary summarize(const Attempt& attempt, std::size_t candidate, bool in_best_attempt) {
  CandidateSummary summary;
  const Eigen::Matrix3d rotation = attempt.candidates[candidate].rotation;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(summary.rotation.data()) =
      attempt.mirrored ? rotation * mirror_matrix() : rotation;
  summary.correlation = attempt.candidates[candidate].correlation;
  summary.chosen = in_best_attempt && attempt.best().candidate == candidate;
  summary.score = std::numeric_limits<double>::infinity();
  for (const Registration& registration : attempt.registrations)
    if (registration.candidate == candidate) summary.score = std::min(summary.score, registration.score);
  if (summary.chosen) summary.score = attempt.best().score;
  return summary;
}

/// The candidates of all attempts, by falling correlation.
std::vector<CandidateSummary> summarize_all(const std::vector<Attempt>& attempts, const Attempt& best) {
  std::vector<CandidateSummary> summaries;
  for (const Attempt& attempt : attempts)
    for (std::size_t i = 0; i < attempt.candidates.size(); ++i) summaries.push_back(summarize(attempt, i, &attempt == &best));
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

// Where a surface is decimated, the registration is of the coarser copies. Then the surfaces themselves are spread over the same
// registered spheres, and the vertices of one are located in the faces of the other.

bool is_coarse(const Surface& source, const Surface& target) { return source.decimated || target.decimated; }

Correspondence forward_map(const Surface& source, const Surface& target, const Registration& best) {
  if (!is_coarse(source, target)) return compose(source, target, best.locations);
  const Points from = spread_over(source, best.source.sphere), to = spread_over(target, best.target.sphere);
  return compose(source, target, locate_all(from, PointLocation(to, target.mesh.faces)));
}

Correspondence reverse_map(const Surface& source, const Surface& target, const Attempt& attempt) {
  const Registration& best = attempt.best();
  std::vector<Location> back = best.back;
  if (is_coarse(source, target)) {
    const Points from = spread_over(target, best.target.sphere), to = spread_over(source, best.source.sphere);
    const Triangles faces = attempt.mirrored ? mirrored_faces(source.mesh.faces) : source.mesh.faces;
    back = locate_all(from, PointLocation(to, faces));
  } else if (back.empty()) {
    back = locate_back(best);
  }
  if (attempt.mirrored) std::transform(back.begin(), back.end(), back.begin(), mirrored_location);
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
  const std::vector<PlacedHint> hints = place_hints(source_shape.surface, target_shape.surface, parameters.hints);
  std::vector<Attempt> attempts = attempts_for(parameters.orientation);
  for (Attempt& attempt : attempts) attempt.candidates = find_candidates(source_shape, attempt.mirrored, target_shape, hints, parameters);
  result.seconds.emplace_back("rotation", watch.lap());

  report("flow", 0.1);
  const SideSignals source_signals(source_shape, parameters), target_signals(target_shape, parameters);
  const Side target(target_shape, target_signals, false);
  for (Attempt& attempt : attempts) {
    attempt.source = std::make_unique<const Side>(source_shape, source_signals, attempt.mirrored);
    const Pair pair{*attempt.source, target, hints, parameters};
    std::vector<Eigen::Matrix3d> rotations;
    for (const RotationCandidate& candidate : attempt.candidates) rotations.push_back(candidate.rotation);
    attempt.registrations = start_registrations(pair, rotations);
    attempt.chosen = flow_candidates(attempt.registrations, pair, progress, threads);
  }
  result.seconds.emplace_back("flow", watch.lap());

  report("correspondence", 0.95);
  const Attempt& best = *std::min_element(attempts.begin(), attempts.end(),
                                          [](const Attempt& a, const Attempt& b) { return a.best().score < b.best().score; });
  result.reversed = best.mirrored;
  result.candidates = summarize_all(attempts, best);
  result.map = forward_map(source_shape.surface, target_shape.surface, best.best());
  if (parameters.both) result.reverse = reverse_map(source_shape.surface, target_shape.surface, best);
  result.quality = measure_map(best.best(), result.candidates);
  result.seconds.emplace_back("correspondence", watch.lap());
  result.seconds.emplace_back("total", total.lap());
  report("correspondence", 1);
  return result;
}

}  // namespace spherematch
