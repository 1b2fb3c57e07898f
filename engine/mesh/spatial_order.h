// A numbering that follows the surface through memory.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/data/tri_mesh.h"

namespace spherematch {

/// All vertices along a curve that fills space (Morton's), ties by index: neighbours on the surface are mostly near each other in it.
/// Work that goes from vertex to neighbour is several times faster on large meshes in this order. `points` are finite.
[[nodiscard]] std::vector<std::int32_t> spatial_order(const Points& points);

/// Vertex i of the result is vertex order[i]; faces go by their lowest vertex, and begin with the corner that they began with.
[[nodiscard]] TriMesh renumbered(const TriMesh& mesh, const std::vector<std::int32_t>& order);

}  // namespace spherematch
