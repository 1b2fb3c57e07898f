// A mesh of any size from one of another: what the benchmarks run on.
#pragma once

#include <cstdint>

#include "engine/data/tri_mesh.h"

namespace spherematch::bench {

/// The same surface with more vertices: the longest edge is halved, again and again, until there are `vertices`. The shape stays exactly
/// what it was, and edges become about equally long. A copy where the mesh has as many already. `mesh` is closed, without boundary.
/// Deterministic. @throws EngineError(non_manifold)
[[nodiscard]] TriMesh subdivided(const TriMesh& mesh, std::int32_t vertices);

/// subdivided(), or where the mesh has more vertices a copy with fewer (engine/mesh/decimate.h).
/// @throws std::runtime_error where the mesh admits no such copy; EngineError(non_manifold)
[[nodiscard]] TriMesh resized(const TriMesh& mesh, std::int32_t vertices);

}  // namespace spherematch::bench
