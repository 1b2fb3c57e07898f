#include "engine/evaluate/map_error.h"

#include <algorithm>

#include "engine/mesh/laplacian.h"

namespace spherematch {

namespace {

/// The value below which `fraction` of the sorted values lie, between neighbours in proportion.
double quantile(const std::vector<double>& sorted, double fraction) {
  const double place = fraction * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

std::vector<double> cumulative_curve(const std::vector<double>& sorted) {
  std::vector<double> curve;
  for (const double threshold : curve_thresholds()) {
    const auto within = std::upper_bound(sorted.begin(), sorted.end(), threshold) - sorted.begin();
    curve.push_back(static_cast<double>(within) / static_cast<double>(sorted.size()));
  }
  return curve;
}

}  // namespace

ScoredLandmarks score_landmarks(const Correspondence& map, const Surface& target, std::span<const Landmark> truth) {
  ScoredLandmarks scored;
  for (const Landmark& landmark : truth) {
    const auto image = image_of(map, target, landmark.source);
    const auto place = place_of(target, landmark.target);
    if (!image || !place) {
      ++scored.unscored;
      continue;
    }
    scored.sources.push_back(landmark.source);
    scored.images.push_back(*image);
    scored.truths.push_back(*place);
  }
  return scored;
}

MapError summarize(std::vector<double> distances, std::int32_t unscored) {
  MapError result;
  result.unscored = unscored;
  if (distances.empty()) return result;
  std::sort(distances.begin(), distances.end());
  const auto count = static_cast<double>(distances.size());
  for (const double distance : distances) {
    result.mean += distance / count;
    result.auc += std::max(1 - distance / curve_end, 0.0) / count;
  }
  result.median = quantile(distances, 0.5);
  result.p95 = quantile(distances, 0.95);
  result.max = distances.back();
  result.curve = cumulative_curve(distances);
  result.scored = static_cast<std::int32_t>(distances.size());
  return result;
}

std::vector<double> relative_distances(const ScoredLandmarks& scored, const Surface& target, const Progress& progress, int threads) {
  std::vector<double> distances = geodesic_distances(target, scored.truths, scored.images, progress, threads);
  const double unit = unit_length(target);
  for (double& distance : distances) distance /= unit;
  return distances;
}

MapError geodesic_error(const Correspondence& map, const Surface& target, std::span<const Landmark> truth, const Progress& progress,
                        int threads) {
  const ScoredLandmarks scored = score_landmarks(map, target, truth);
  return summarize(relative_distances(scored, target, progress, threads), scored.unscored);
}

double mean_by_area(const Surface& source, std::span<const std::int32_t> sources, std::span<const double> values) {
  const Eigen::VectorXd areas = vertex_areas(source.mesh.vertices, source.mesh.faces);
  // Welded vertices, and sources with several landmarks, share the area of their place.
  std::vector<int> sharers(static_cast<std::size_t>(areas.size()), 0);
  const auto vertex_of = [&](std::size_t i) { return source.surface_vertex[static_cast<std::size_t>(sources[i])]; };
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (vertex_of(i) >= 0) ++sharers[static_cast<std::size_t>(vertex_of(i))];
  double sum = 0, area = 0;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (vertex_of(i) < 0) continue;
    const double share = areas[vertex_of(i)] / sharers[static_cast<std::size_t>(vertex_of(i))];
    sum += share * values[i];
    area += share;
  }
  return area > 0 ? sum / area : 0;
}

}  // namespace spherematch
