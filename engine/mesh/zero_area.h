// Triangles without area. Internal to engine/mesh.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <vector>

namespace spherematch {

struct Draft;

/// True when the height over the longest side is below 1e-10 of that side: corners in one line, up to the rounding of coordinates.
[[nodiscard]] inline bool is_zero_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  constexpr double flattest = 1e-10;
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return !((b - a).cross(c - a).norm() > flattest * longest);
}

/// Removes triangles of zero area from the closed, numbered draft and counts them as removed. An edge whose ends coincide is collapsed
/// onto its lower vertex (draft.vertex changes; the corners stay as uploaded, and the merged vertex counts as welded); otherwise
/// the longest edge is flipped when both new triangles have area, and since those are no uploaded triangles, their corners
/// become -1. What neither can be done to, without making an edge twice, stays. Linear in the number of such triangles.
/// Returns, per vertex of the draft, the vertex that it now is.
std::vector<std::int32_t> remove_zero_area_faces(Draft& draft);

}  // namespace spherematch
