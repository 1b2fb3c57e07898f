// Boundary loops into patches. Internal to engine/mesh.
#pragma once

#include "engine/mesh/draft.h"

namespace spherematch {

/// Closes every boundary loop of the numbered, consistently oriented draft and counts loops, faces and vertices added. A loop of two
/// edges is glued shut. A longer one is triangulated over its own vertices (triangulate_polygon()) with chords that are no edge
/// of the surface; where there is no such triangulation, or it would take too long, a fan round a new vertex at the mean of
/// the loop closes it.
void fill_holes(Draft& draft);

}  // namespace spherematch
