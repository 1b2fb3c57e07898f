// From the source to the target and back, by two maps.
#pragma once

#include "engine/data/correspondence.h"
#include "engine/data/progress.h"
#include "engine/data/surface.h"
#include "engine/evaluate/map_error.h"

namespace spherematch {

/// For every uploaded source vertex: where `reverse` takes its image under `map`, and the vertex itself as the truth. Between the target's
/// vertices `reverse` is what PointImages makes of it. @throws EngineError(invalid_parameter, cancelled)
[[nodiscard]] ScoredLandmarks round_trips(const Correspondence& map, const Correspondence& reverse, const Surface& source,
                                          const Surface& target, const Progress& progress = {});

}  // namespace spherematch
