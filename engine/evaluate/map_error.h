// How far a map is from the truth.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/correspondence.h"
#include "engine/data/evaluation.h"
#include "engine/data/progress.h"
#include "engine/data/surface.h"
#include "engine/evaluate/surface_distance.h"

namespace spherematch {

/// Where a map takes landmarks and where they belong, on the target.
struct ScoredLandmarks {
  std::vector<std::int32_t> sources;  ///< uploaded vertices of the source
  std::vector<PlacedPoint> images;
  std::vector<PlacedPoint> truths;
  std::int32_t unscored = 0;  ///< left out, at a dropped vertex of either shape
};

/// @throws EngineError(invalid_parameter) when a landmark is not a vertex, or the map not one to this target
[[nodiscard]] ScoredLandmarks score_landmarks(const Correspondence& map, const Surface& target, std::span<const Landmark> truth);

/// Figures and the cumulative curve of distances.
[[nodiscard]] MapError summarize(std::vector<double> distances, std::int32_t unscored);

/// Distances along the target's surface (geodesic_distances()), divided by the square root of its area.
/// Thread-safe, deterministic. @throws EngineError as score_landmarks(), EngineError(cancelled)
[[nodiscard]] MapError geodesic_error(const Correspondence& map, const Surface& target, std::span<const Landmark> truth,
                                      const Progress& progress = {}, int threads = 1);

/// Distances between images and truths along the target's surface (geodesic_distances()), divided by the square root of its area.
[[nodiscard]] std::vector<double> relative_distances(const ScoredLandmarks& scored, const Surface& target, const Progress& progress,
                                                     int threads);

/// The mean of `values` by the areas of the source round its vertices, which is their integral over the source at unit area. values[i]
/// belongs to uploaded vertex sources[i]; vertices that do not occur count as the mean of those that do. 0 where none has an area.
[[nodiscard]] double mean_by_area(const Surface& source, std::span<const std::int32_t> sources, std::span<const double> values);

}  // namespace spherematch
