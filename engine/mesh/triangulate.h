// The first step of repair: polygons into triangles, less the useless ones. Internal to engine/mesh.
#pragma once

#include "engine/data/surface.h"
#include "engine/mesh/draft.h"

namespace spherematch {

/// Fills an empty draft with the triangles of its upload, unglued. Polygons of more than three corners are triangulated by
/// triangulate_polygon() with chords that are no edge of another polygon; where that fails or would take too long, by a fan.
/// Faces with a repeated corner and duplicates (the same three vertices in any order, all but the first) are left out and counted.
/// @throws EngineError(degenerate) in RepairMode::none when a face would be left out
void triangulate(Draft& draft, RepairMode mode);

}  // namespace spherematch
