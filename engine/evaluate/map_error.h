// How far a map is from the truth, along the target's surface.
#pragma once

#include <span>

#include "engine/data/correspondence.h"
#include "engine/data/evaluation.h"
#include "engine/data/surface.h"

namespace spherematch {

/// Distances are those of GeodesicGraph, from the nearest corner of an image on in a straight line; so they are 2 to 3 percent high.
/// Thread-safe, deterministic.
/// @throws EngineError(invalid_parameter) when a landmark is not a vertex, or the map not one to this target
[[nodiscard]] MapError geodesic_error(const Correspondence& map, const Surface& target, std::span<const Landmark> truth);

}  // namespace spherematch
