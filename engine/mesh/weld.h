// Seams: boundary edges that lie in the same place are glued. Internal to engine/mesh.
#pragma once

#include "engine/mesh/draft.h"

namespace spherematch {

/// Glues boundary half-edges whose ends coincide exactly (0 and -0 do), after leaving out all but the first of loose triangles
/// in the same place. Does nothing to a mesh without boundary.
void glue_seams(Draft& draft);

/// Numbers the vertices so that no edge has one vertex at both ends and no two edges have the same two vertices, as far as it can:
/// where two glued edges have, the four faces are glued the other way round once; then welds there are opened again.
void number_vertices_without_double_edges(Draft& draft);

/// @throws EngineError(non_manifold) when two edges of the numbered draft have the same two vertices
void refuse_double_edges(const Draft& draft);

}  // namespace spherematch
