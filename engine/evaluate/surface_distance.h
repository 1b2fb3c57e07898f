// Points of a surface, as maps speak of them, and how far they are apart along it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/data/correspondence.h"
#include "engine/data/progress.h"
#include "engine/data/surface.h"

namespace spherematch {

/// A point with weights in three vertices of Surface::mesh, which need not differ; a vertex is itself three times.
struct PlacedPoint {
  std::array<std::int32_t, 3> corners{};
  std::array<double, 3> weights{};
  Eigen::RowVector3d position;
};

// Both give nothing where the vertex was dropped. @throws EngineError(invalid_parameter) for what is no uploaded vertex

/// An uploaded vertex of the surface.
[[nodiscard]] std::optional<PlacedPoint> place_of(const Surface& surface, std::int32_t uploaded);
/// Row `source` of the map.
[[nodiscard]] std::optional<PlacedPoint> image_of(const Correspondence& map, const Surface& target, std::int32_t source);
/// All rows of the map.
[[nodiscard]] std::vector<std::optional<PlacedPoint>> images_of(const Correspondence& map, const Surface& target);

/// @throws EngineError(invalid_parameter) where the map does not have a row for each uploaded vertex of the source
void require_rows(const Correspondence& map, const Surface& source);

/// Square root of the surface's area: the unit of lengths.
[[nodiscard]] double unit_length(const Surface& surface);

/// Distance between from[i] and to[i], in the unit of the mesh: the straight line between points with a corner in common, else the
/// shortest path of GeodesicGraph between their corners, with straight lines at its ends; so it is 2 to 3 percent high. Uses up to
/// `threads` threads; the result does not depend on their number. @throws EngineError(cancelled)
[[nodiscard]] std::vector<double> geodesic_distances(const Surface& surface, std::span<const PlacedPoint> from,
                                                     std::span<const PlacedPoint> to, const Progress& progress, int threads);

}  // namespace spherematch
