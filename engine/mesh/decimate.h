// A coarser copy of a closed surface, for shapes with more vertices than the method needs.
#pragma once

#include <optional>

#include "engine/data/surface.h"

namespace spherematch {

/// Collapses the shortest edge to its middle, unless that turns a face over, until `vertices` (at least 4) are left or none can be
/// collapsed. The copy is closed, manifold, of genus zero and faces outward. The place of each vertex is the nearest point of the copy, as
/// found by walking from the vertex that it was collapsed into, so that sheets which touch stay apart. Nothing where the mesh has no
/// more vertices, or admits no such copy in reasonable time. `mesh` fulfils the invariants of Surface. Thread-safe, deterministic.
[[nodiscard]] std::optional<DecimatedMesh> decimate(const TriMesh& mesh, std::int32_t vertices);

}  // namespace spherematch
