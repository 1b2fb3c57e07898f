// What a map does to the edges and faces of its source.
#pragma once

#include "engine/data/correspondence.h"
#include "engine/data/evaluation.h"
#include "engine/data/progress.h"
#include "engine/data/surface.h"

namespace spherematch {

/// Looks at the faces whose corners are all uploaded, and at their edges. The image of an edge is as long as the geodesic distance of its
/// ends' images (geodesic_distances()); the image of a face is the flat triangle between those of its corners. All zero where nothing
/// has an image. Thread-safe; the result does not depend on `threads`.
/// @throws EngineError(invalid_parameter) when the map is not one between these surfaces, EngineError(cancelled)
[[nodiscard]] Continuity measure_continuity(const Correspondence& map, const Surface& source, const Surface& target,
                                            const Progress& progress = {}, int threads = 1);

}  // namespace spherematch
