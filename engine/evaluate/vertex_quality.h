// What to think of a map at each vertex.
#pragma once

#include "engine/data/correspondence.h"
#include "engine/data/evaluation.h"
#include "engine/register/match_shape.h"

namespace spherematch {

/// Of a map between these shapes as they were prepared, not their mirror images. Thread-safe, deterministic. Some 50 ms for 50,000
/// vertices.
/// @throws EngineError(invalid_parameter) when the map is not one between these shapes
[[nodiscard]] VertexQuality vertex_quality(const MatchShape& source, const MatchShape& target, const Correspondence& map);

}  // namespace spherematch
