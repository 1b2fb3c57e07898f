#include "engine/evaluate/bijectivity.h"

#include <array>
#include <optional>

#include "engine/register/point_images.h"

namespace spherematch {

namespace {

/// The image of an image, placed on the source.
std::optional<PlacedPoint> returned(PointImages& back, const Correspondence& map, const Surface& source, Eigen::Index row) {
  std::array<std::int32_t, 3> corners{};
  std::array<double, 3> weights{};
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = map.corners(row, static_cast<Eigen::Index>(k));
    weights[k] = static_cast<double>(map.bary(row, static_cast<Eigen::Index>(k)));
  }
  const auto image = back.of_corners(corners, weights);
  if (!image) return std::nullopt;
  PlacedPoint point{{}, image->bary, image->position.transpose()};
  for (std::size_t k = 0; k < 3; ++k) point.corners[k] = source.surface_vertex[static_cast<std::size_t>(image->corners[k])];
  return point;
}

}  // namespace

ScoredLandmarks round_trips(const Correspondence& map, const Correspondence& reverse, const Surface& source, const Surface& target,
                            const Progress& progress) {
  require_rows(map, source);
  require_rows(reverse, target);
  PointImages back(reverse, target, source);
  (void)images_of(map, target);      // both are held against the surfaces
  (void)images_of(reverse, source);  // that they speak of, before they are put together
  ScoredLandmarks trips;
  for (std::int32_t v = 0; v < source.uploaded_vertices(); ++v) {
    if (v % 256 == 0) progress.check();
    const auto start = place_of(source, v);
    const bool has_image = map.vertex[static_cast<std::size_t>(v)] >= 0;
    const auto end = start && has_image ? returned(back, map, source, v) : std::nullopt;
    if (!end) {
      ++trips.unscored;
      continue;
    }
    trips.sources.push_back(v);
    trips.images.push_back(*end);
    trips.truths.push_back(*start);
  }
  return trips;
}

}  // namespace spherematch
