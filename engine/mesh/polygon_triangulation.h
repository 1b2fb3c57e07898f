// Triangles over a closed polygon in space, without added points. Internal to engine/mesh.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace spherematch {

/// Polygons of more corners than this are not triangulated by the cubic method below.
constexpr std::int64_t most_triangulated_corners = 500;

/// Three indices into the polygon each, running the same way round as the polygon.
using PolygonTriangles = std::vector<std::array<std::int32_t, 3>>;

/// The triangulation of least cost, where a triangle costs its area and, so that slivers lose among triangulations of equal area, a
/// small part of its squared edge lengths (the dynamic programme of Barequet and Sharir 1995). Only chords that `allowed` accepts are
/// used; it is asked with i < j about corners that are not neighbours. Cubic time, quadratic memory.
/// Nothing when no triangulation has allowed chords alone, or when there are more than most_triangulated_corners.
[[nodiscard]] std::optional<PolygonTriangles> triangulate_polygon(const std::vector<Eigen::Vector3d>& polygon,
                                                                  const std::function<bool(std::int32_t, std::int32_t)>& allowed);

/// The work that the method spends on a polygon, in triangles weighed.
[[nodiscard]] constexpr std::int64_t triangulation_work(std::int64_t corners) { return corners * corners * corners / 6; }

}  // namespace spherematch
