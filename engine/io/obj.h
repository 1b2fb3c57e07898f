// The Wavefront OBJ format: positions and polygons. Texture coordinates, normals, groups, materials, lines, points and free-form
// curves and surfaces are skipped. Source: the format's description in appendix B1 of the Advanced Visualizer manual.
#pragma once

#include <string_view>

#include "engine/data/parameters.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

/// OBJ has no signature: true when the text starts with statements of the format's keywords, up to a `v` with a number after it.
[[nodiscard]] bool is_obj(std::string_view text);

/// One vertex for each `v`, what follows its three coordinates is ignored; one polygon for each `f`, whose corners may be `v`, `v/vt`,
/// `v//vn` or `v/vt/vn` and may count backwards. A face may name vertices that come after it. A backslash joins lines of a `v` or `f`.
/// @throws EngineError(malformed_mesh) with the line, EngineError(too_many_vertices), EngineError(degenerate) as read_mesh() does
[[nodiscard]] PolygonMesh read_obj(std::string_view text, const ReadLimits& limits = {});

}  // namespace spherematch
