// Orientation of the draft's faces. Internal to engine/mesh.
#pragma once

#include "engine/data/surface.h"
#include "engine/mesh/draft.h"

namespace spherematch {

/// Turns faces so that glued ones agree, as far as the surface is orientable. A weld that contradicts the edges glued before it is
/// opened again; contradictions of edges glued by index stay, marked by Draft::same_way. Near-linear.
void agree_orientations(Draft& draft);

/// @throws EngineError(inconsistent_orientation) when a contradiction is left
void refuse_contradictions(const Draft& draft);

/// Turns all faces of the closed, numbered draft when its signed volume is negative.
/// @throws EngineError(degenerate) when it encloses no volume; EngineError(inconsistent_orientation) in RepairMode::none
/// when the faces point inward
void turn_outward(Draft& draft, RepairMode mode);

}  // namespace spherematch
