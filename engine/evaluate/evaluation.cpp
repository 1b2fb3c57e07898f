#include "engine/evaluate/evaluation.h"

#include <chrono>
#include <cmath>

#include "engine/evaluate/biharmonic.h"
#include "engine/evaluate/bijectivity.h"
#include "engine/evaluate/continuity.h"
#include "engine/evaluate/coverage.h"
#include "engine/evaluate/map_error.h"

namespace spherematch {

namespace {

using Clock = std::chrono::steady_clock;

bool has_eigenbasis(const PreprocessedShape& shape) { return shape.eigenvectors.size() > 0; }

/// With the mean by area where the landmarks are dense on the source.
MapError summary(const ScoredLandmarks& scored, const std::vector<double>& distances, const Surface& source, bool dense) {
  MapError error = summarize(distances, scored.unscored);
  if (dense && error.scored > 0) error.area_mean = mean_by_area(source, scored.sources, distances);
  return error;
}

/// Of the squared distances, over the source of the map that they were scored with.
double integral_of_squares(const Surface& source, const ScoredLandmarks& scored, std::vector<double> distances) {
  for (double& distance : distances) distance *= distance;
  return mean_by_area(source, scored.sources, distances);
}

std::vector<Landmark> turned_round(const std::vector<Landmark>& landmarks) {
  std::vector<Landmark> result;
  result.reserve(landmarks.size());
  for (const Landmark& landmark : landmarks) result.push_back({landmark.target, landmark.source});
  return result;
}

void measure_errors(Evaluation& result, const PreprocessedShape& source, const PreprocessedShape& target, const Correspondence& map,
                    const Correspondence* reverse, const GroundTruth& truth, const Progress& progress, int threads) {
  if (truth.direct.empty()) return;
  const ScoredLandmarks scored = score_landmarks(map, target.surface, truth.direct);
  result.geodesic = summary(scored, relative_distances(scored, target.surface, progress, threads), source.surface, truth.dense);
  if (!truth.mirrored.empty()) {
    result.mirrored = geodesic_error(map, target.surface, truth.mirrored, progress, threads);
    result.flipped = result.mirrored->mean < result.geodesic->mean;
  }
  if (!has_eigenbasis(target)) return;
  const std::vector<double> distances = biharmonic_distances(target, scored.images, scored.truths, progress);
  result.biharmonic = summary(scored, distances, source.surface, truth.dense);
  if (!truth.dense || reverse == nullptr || !has_eigenbasis(source)) return;
  const ScoredLandmarks back = score_landmarks(*reverse, source.surface, turned_round(truth.direct));
  const std::vector<double> distances_back = biharmonic_distances(source, back.images, back.truths, progress);
  result.symmetric_integral =
      std::sqrt(integral_of_squares(source.surface, scored, distances) + integral_of_squares(target.surface, back, distances_back));
}

void measure_bijectivity(Evaluation& result, const PreprocessedShape& source, const PreprocessedShape& target, const Correspondence& map,
                         const Correspondence& reverse, const Progress& progress, int threads) {
  const ScoredLandmarks trips = round_trips(map, reverse, source.surface, target.surface, progress);
  result.bijectivity = summary(trips, relative_distances(trips, source.surface, progress, threads), source.surface, true);
  if (!has_eigenbasis(source)) return;
  result.bijectivity_biharmonic = summary(trips, biharmonic_distances(source, trips.images, trips.truths, progress), source.surface, true);
}

}  // namespace

Evaluation evaluate_map(const PreprocessedShape& source, const PreprocessedShape& target, const Correspondence& map,
                        const Correspondence* reverse, const GroundTruth& truth, const Progress& progress, int threads) {
  require_rows(map, source.surface);
  if (reverse != nullptr) require_rows(*reverse, target.surface);
  Evaluation result;
  const auto began = Clock::now();
  auto stage_began = began;
  const auto seconds_since = [](Clock::time_point time) { return std::chrono::duration<double>(Clock::now() - time).count(); };
  double done = 0;
  const auto stage = [&](const char* name, const auto& measure) {
    if (progress.report) progress.report(name, done);
    measure();
    result.seconds.emplace_back(name, seconds_since(stage_began));
    stage_began = Clock::now();
    done += 0.25;
  };
  stage("errors", [&] { measure_errors(result, source, target, map, reverse, truth, progress, threads); });
  stage("continuity", [&] { result.continuity = measure_continuity(map, source.surface, target.surface, progress, threads); });
  stage("coverage", [&] { result.coverage = measure_coverage(map, source.surface, target.surface, progress); });
  if (reverse != nullptr) {
    stage("bijectivity", [&] { measure_bijectivity(result, source, target, map, *reverse, progress, threads); });
  }
  result.seconds.emplace_back("total", seconds_since(began));
  return result;
}

}  // namespace spherematch
