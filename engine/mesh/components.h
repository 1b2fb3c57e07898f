// Connected parts of the draft. Internal to engine/mesh.
#pragma once

#include "engine/data/surface.h"
#include "engine/mesh/draft.h"

namespace spherematch {

/// Keeps the component of largest area, the first of equals, and counts what goes. The draft must be glued.
/// @throws EngineError(disconnected) in RepairMode::none when there is more than one component;
/// EngineError(degenerate) when the largest has no area or no finite one
void keep_largest_component(Draft& draft, RepairMode mode);

}  // namespace spherematch
