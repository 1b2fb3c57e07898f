// Which triangles continue each other across an edge. Internal to engine/mesh.
#pragma once

#include <vector>

#include "engine/data/surface.h"
#include "engine/mesh/draft.h"

namespace spherematch {

/// A half-edge known by its two ends: uploaded vertices, or places in space.
struct EdgeEnd {
  std::int32_t low;
  std::int32_t high;
  HalfEdge half_edge;
  bool rising;  ///< runs from low to high
  bool operator<(const EdgeEnd& other) const {
    if (low != other.low) return low < other.low;
    if (high != other.high) return high < other.high;
    return half_edge < other.half_edge;
  }
};

/// Glues the half-edges that share both ends. Two are simply glued. Of more, the pairs that enclose the solid between them are
/// glued when the orientations alternate round the edge, so that solids which touch along it come apart; otherwise the
/// flattest pairs, opposite orientations first, and what remains stays boundary. Sorts `ends`.
void glue_groups(Draft& draft, std::vector<EdgeEnd>& ends, bool by_weld);

/// Glues by uploaded vertex indices.
/// @throws EngineError(non_manifold, inconsistent_orientation, not_closed) in RepairMode::none, in this order
void glue_by_index(Draft& draft, RepairMode mode);

}  // namespace spherematch
