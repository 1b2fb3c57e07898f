// A renumbering of a mesh in which near vertices have near numbers, so that loops over faces find their corners in the cache.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/data/tri_mesh.h"

namespace spherematch {

struct OrderedMesh {
  TriMesh mesh;
  std::vector<std::int32_t> original;  ///< of each vertex of `mesh`: its number before
};

/// Vertices along a Morton curve through their bounding box, faces by their lowest vertex; each face keeps the order of its corners.
/// Coordinates must be finite. Deterministic.
[[nodiscard]] OrderedMesh spatially_ordered(const TriMesh& mesh);

/// Rows of `values` (V, 3) as the ordered mesh numbers them, and back.
[[nodiscard]] Points to_ordered(const OrderedMesh& order, const Points& values);
[[nodiscard]] Points to_original(const OrderedMesh& order, const Points& values);

}  // namespace spherematch
