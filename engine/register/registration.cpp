#include "engine/register/registration.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/data/error.h"
#include "engine/register/candidate_flow.h"
#include "engine/register/composition.h"
#include "engine/register/hints.h"
#include "engine/register/mirror.h"
#include "engine/register/rotation.h"
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

/// Names of the signals that rotations are aligned by: that of rotation_time and, but for the paper's method, that of half the time, where
/// it is stored. On bodies that are nearly round the first alone says too little.
std::vector<std::string> rotation_signals(const PreprocessedShape& shape, const MatchParameters& parameters) {
  std::vector<std::string> names{hks_name(parameters.rotation_time)};
  const std::string half = hks_name(parameters.rotation_time / 2);
  const auto is_half = [&half](const SignalGrid& signal) { return signal.name == half; };
  if (!parameters.paper_selection && std::any_of(shape.signals.begin(), shape.signals.end(), is_half)) names.push_back(half);
  return names;
}

/// The best rotations of the stored signals and, where hints determine one, that of the hints, by falling correlation.
std::vector<RotationCandidate> find_candidates(const MatchShape& source, const MatchShape& target, const HintDirections& hints,
                                               const MatchParameters& parameters) {
  std::vector<Harmonics> f, g;
  const auto resolution = [](const MatchShape& shape) { return shape.shape().signals.front().values.rows(); };
  const Eigen::Index finest = std::min(resolution(source), resolution(target));
  const int degree = std::min(parameters.rotation_bandwidth, static_cast<int>(finest) / 2) - 1;
  const auto harmonics = [degree](const Grid& grid) { return HarmonicTransform(static_cast<int>(grid.rows()), degree).analyze(grid); };
  for (const std::string& name : rotation_signals(source.shape(), parameters)) {
    f.push_back(harmonics(source.signal(name)));
    g.push_back(harmonics(target.signal(name)));
  }
  std::vector<RotationCandidate> candidates = align_rotations(f, g, degree, parameters);
  if (const auto hinted = rotation_from_hints(hints)) {
    const RotationCandidate extra{*hinted, rotation_correlation(f, g, degree, *hinted)};
    const auto better = [](const RotationCandidate& a, const RotationCandidate& b) { return a.correlation > b.correlation; };
    candidates.insert(std::upper_bound(candidates.begin(), candidates.end(), extra, better), extra);
  }
  return candidates;
}

/// All that is done with the source as it is, or with its mirror image.
struct Attempt {
  PairSide source;
  HintDirections hints;
  std::vector<RotationCandidate> candidates{};
  std::vector<Registration> registrations{};
  std::vector<std::size_t> finished{};  ///< indices of those that went through the whole flow, best first
};

/// A registration and the attempt that it is of.
struct Choice {
  const Attempt* attempt;
  Registration* registration;
};

/// The best finished registration of each rotation, by rising score.
std::vector<Choice> rank(std::vector<Attempt>& attempts) {
  std::vector<Choice> choices;
  for (Attempt& attempt : attempts) {
    for (const std::size_t i : attempt.finished) {
      Registration& registration = attempt.registrations[i];
      const bool known = std::any_of(choices.begin(), choices.end(), [&](const Choice& better) {
        return better.attempt == &attempt && better.registration->candidate == registration.candidate;
      });
      if (!known) choices.push_back({&attempt, &registration});
    }
  }
  std::stable_sort(choices.begin(), choices.end(),
                   [](const Choice& a, const Choice& b) { return a.registration->score < b.registration->score; });
  return choices;
}

/// The one that the caller asks for. @throws EngineError(invalid_parameter)
Choice choose(const std::vector<Choice>& ranked, int candidate) {
  if (static_cast<std::size_t>(candidate) < ranked.size()) return ranked[static_cast<std::size_t>(candidate)];
  throw EngineError(ErrorCode::invalid_parameter, "candidate: there is no candidate " + std::to_string(candidate) + "; " +
                                                      std::to_string(ranked.size()) + " were followed to the end, numbered from 0");
}

/// Whether the next best map scores so nearly the same that it may be the right one. Measured on 58 pairs, of which it is true for 4, all
/// between gorillas and people: the best was right there too, but by an eighth only.
bool ambiguous(const std::vector<Choice>& ranked) {
  constexpr double kMargin = 0.15, kExact = 0.001;  // the latter where both scores are next to nothing
  if (ranked.size() < 2) return false;
  const double best = ranked[0].registration->score, next = ranked[1].registration->score;
  return next - best < std::max(kMargin * best, kExact);
}

/// A rotation with the score of its chosen registration, else of its best.
CandidateSummary summarize(const Attempt& attempt, std::size_t candidate, const Choice& chosen, bool exchanged) {
  CandidateSummary summary;
  Eigen::Matrix3d rotation = attempt.candidates[candidate].rotation;
  if (attempt.source.shape.mirrored()) rotation = rotation * mirror_matrix();
  if (exchanged) rotation.transposeInPlace();
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(summary.rotation.data()) = rotation;
  summary.correlation = attempt.candidates[candidate].correlation;
  summary.chosen = chosen.attempt == &attempt && chosen.registration->candidate == candidate;
  summary.score = std::numeric_limits<double>::infinity();
  for (const Registration& registration : attempt.registrations)
    if (registration.candidate == candidate) summary.score = std::min(summary.score, registration.score);
  if (summary.chosen) summary.score = chosen.registration->score;
  return summary;
}

/// The candidates of all attempts, by falling correlation.
std::vector<CandidateSummary> summarize_all(const std::vector<Attempt>& attempts, const Choice& chosen, bool exchanged) {
  std::vector<CandidateSummary> summaries;
  for (const Attempt& attempt : attempts)
    for (std::size_t i = 0; i < attempt.candidates.size(); ++i) summaries.push_back(summarize(attempt, i, chosen, exchanged));
  std::stable_sort(summaries.begin(), summaries.end(), [](const auto& a, const auto& b) { return a.correlation > b.correlation; });
  return summaries;
}

/// The lowest score of another finished registration, zero where there is none. The others' scores are of the coarse flow alone.
double runner_up_score(const std::vector<Choice>& ranked, const Choice& chosen) {
  for (const Choice& choice : ranked)
    if (choice.registration != chosen.registration) return choice.registration->score;
  return 0;
}

struct HalfMap {
  std::vector<Location> locations;  ///< of the vertices of one surface in the faces of the other
  std::size_t flipped = 0;          ///< faces that the map turns over
};

/// One direction of a registration, from the `images` of the vertices of one shape on the sphere of the other. A face may be turned over
/// though the map is a bijection, being straight where that is bent: then its corners are moved a little.
HalfMap map_vertices(const MatchShape& from, Points images, const MatchShape& to, int threads) {
  HalfMap result;
  if (!from.repair().repair(images)) result.flipped = flipped_faces(images, from.faces()).size();
  result.locations = locate_all(images, to.location(), threads);
  if (to.mirrored()) std::transform(result.locations.begin(), result.locations.end(), result.locations.begin(), mirrored_location);
  return result;
}

/// An order of shapes. A pair is registered in this order, so that the maps from source to target and from target to source are of the same
/// registration, whichever is asked for.
bool comes_before(const MatchShape& a, const MatchShape& b) {
  const Points &p = a.sphere(), &q = b.sphere();
  if (p.size() != q.size()) return p.size() < q.size();
  return std::lexicographical_compare(p.data(), p.data() + p.size(), q.data(), q.data() + q.size());
}

}  // namespace

MatchResult register_pair(const MatchShape& source, const MatchShape& target, const MatchParameters& parameters, const Progress& progress,
                          int threads) {
  const auto report = [&progress](const char* stage, double fraction) {
    if (progress.report) progress.report(stage, fraction);
  };
  Stopwatch total, watch;
  MatchResult result;

  report("rotation", 0);
  std::vector<PlacedHint> hints = place_hints(source.surface(), target.surface(), parameters.hints);
  const bool exchanged = comes_before(target, source);
  const MatchShape &first = exchanged ? target : source, &second = exchanged ? source : target;
  if (exchanged)
    for (PlacedHint& hint : hints) std::swap(hint.source, hint.target);
  const PairSide second_side(second, parameters);
  std::unique_ptr<const MatchShape> mirror_image;
  std::vector<Attempt> attempts;
  const auto attempt_with = [&](const MatchShape& shape) {
    attempts.push_back({PairSide(shape, parameters), directions(hints, shape.working_sphere(), second.working_sphere())});
  };
  if (parameters.orientation != Orientation::reverse) attempt_with(first);
  if (parameters.orientation != Orientation::preserve) attempt_with(*(mirror_image = first.mirror_image()));
  for (Attempt& attempt : attempts) attempt.candidates = find_candidates(attempt.source.shape, second, attempt.hints, parameters);
  result.seconds.emplace_back("rotation", watch.lap());

  report("flow", 0.1);
  for (Attempt& attempt : attempts) {
    const Pair pair{attempt.source, second_side, attempt.hints, parameters};
    std::vector<Eigen::Matrix3d> rotations;
    for (const RotationCandidate& candidate : attempt.candidates) rotations.push_back(candidate.rotation);
    attempt.registrations = start_registrations(pair, rotations);
    attempt.finished = flow_candidates(attempt.registrations, pair, progress, threads);
  }
  result.seconds.emplace_back("flow", watch.lap());

  report("refinement", 0.5);
  const std::vector<Choice> ranked = rank(attempts);
  const Choice chosen = choose(ranked, parameters.candidate);
  Registration& registration = *chosen.registration;
  refine({chosen.attempt->source, second_side, chosen.attempt->hints, parameters}, registration, progress, threads);
  result.seconds.emplace_back("refinement", watch.lap());

  report("correspondence", 0.9);
  const MatchShape& first_matched = chosen.attempt->source.shape;
  const MatchShape &from = exchanged ? second : first_matched, &to = exchanged ? first_matched : second;
  result.reversed = first_matched.mirrored();
  result.candidates = summarize_all(attempts, chosen, exchanged);
  const NodeMap& map = *registration.map;
  const auto along = [&](const Points& points, bool forward) {
    return forward ? map.forward(points, threads) : map.backward(points, threads);
  };
  const HalfMap there = map_vertices(from, along(from.sphere(), !exchanged), to, threads);
  result.map = compose(source.surface(), target.surface(), there.locations);
  result.quality = {{"bijective", map.bijective() ? 1 : 0}, {"flipped_source", static_cast<double>(there.flipped)}};
  if (parameters.both) {
    const HalfMap back = map_vertices(to, along(to.sphere(), exchanged), from, threads);
    result.reverse = compose(target.surface(), source.surface(), back.locations);
    const RoundTrip trip = round_trip(source.surface(), target.surface(), there.locations, back.locations);
    result.quality.emplace_back("flipped_target", static_cast<double>(back.flipped));
    result.quality.emplace_back("inverse_mean", trip.mean);
    result.quality.emplace_back("inverse_largest", trip.largest);
  }
  if (!parameters.elastic_iterations.empty()) result.quality.emplace_back("strain", std::sqrt(registration.strain));
  result.quality.emplace_back("score", registration.score);
  result.quality.emplace_back("score_runner_up", runner_up_score(ranked, chosen));
  result.quality.emplace_back("ambiguous", ambiguous(ranked) ? 1 : 0);
  result.seconds.emplace_back("correspondence", watch.lap());
  result.seconds.emplace_back("total", total.lap());
  report("correspondence", 1);
  return result;
}

}  // namespace spherematch
