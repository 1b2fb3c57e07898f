// How much of the target a map reaches.
#pragma once

#include "engine/data/correspondence.h"
#include "engine/data/evaluation.h"
#include "engine/data/progress.h"
#include "engine/data/surface.h"

namespace spherematch {

/// The image of a source face is the flat triangle between the images of its corners; it covers the faces of the target near them whose
/// centres lie over it, or beside it by a tenth of its size, as flat triangles over a curved surface leave gaps. Only faces whose
/// corners are all uploaded count, on either side. Deterministic, thread-safe. Time in proportion to the faces of both.
/// @throws EngineError(invalid_parameter) when the map is not one between these surfaces, EngineError(cancelled)
[[nodiscard]] Coverage measure_coverage(const Correspondence& map, const Surface& source, const Surface& target,
                                        const Progress& progress = {});

}  // namespace spherematch
