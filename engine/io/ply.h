// The PLY format, ASCII and binary of either byte order: positions and polygons. Every other element and property is skipped.
// Source: G. Turk, "The PLY Polygon File Format", and the type names that later writers added.
#pragma once

#include <string_view>

#include "engine/data/parameters.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

/// True when the first line is "ply".
[[nodiscard]] bool is_ply(std::string_view text);

/// Reads `x`, `y`, `z` of the element `vertex`, and the list `vertex_indices` or `vertex_index` of the element `face`, of any type and in
/// any order. What follows the last row that is needed is not looked at.
/// @throws EngineError(malformed_mesh) with the line, or the byte in binary rows, EngineError(too_many_vertices),
/// EngineError(degenerate) as read_mesh() does
[[nodiscard]] PolygonMesh read_ply(std::string_view text, const ReadLimits& limits = {});

}  // namespace spherematch
