// The OFF format, as Geomview describes it, ASCII only: positions and faces; normals, colours and texture coordinates are
// skipped. http://www.geomview.org/docs/html/OFF.html
#pragma once

#include <string>
#include <string_view>

#include "engine/data/parameters.h"
#include "engine/data/tri_mesh.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

/// True when the first word is an OFF keyword: [ST][C][N][4][n]OFF.
[[nodiscard]] bool is_off(std::string_view text);

/// Reads OFF, COFF, NOFF, STOFF and their combinations. The keyword may be missing or share its line with the counts, the edge
/// count is optional, '#' starts a comment, a vertex and a face each fill one line, and what follows a face's indices is its
/// colour. Numbers are read independently of the locale.
/// @throws EngineError(malformed_mesh) with the line, EngineError(unsupported_format) for binary, four- and n-dimensional OFF,
/// EngineError(too_many_vertices), EngineError(degenerate) as read_mesh() does
[[nodiscard]] PolygonMesh read_off(std::string_view text, const ReadLimits& limits = {});

/// Writes numbers in their shortest form that reads back to the same double.
[[nodiscard]] std::string write_off(const TriMesh& mesh);

}  // namespace spherematch
