// The STL format, ASCII and binary: triangles by the positions of their corners. Normals, names and attributes are skipped.
// Source: the description in M. Burns, "Automated Fabrication" (1993), section 6.5.
#pragma once

#include <string_view>

#include "engine/data/parameters.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

/// True when the file is as long as its number of triangles says, or its first word is "solid". Binary files have no signature, and
/// some of them start with "solid" too.
[[nodiscard]] bool is_stl(std::string_view text);

/// The vertices are the distinct positions in the order of their first appearance; positions are equal when their coordinates are, and
/// -0 is 0. The triangles of all solids of an ASCII file are taken together, its keywords may be of either case. A triangle with equal
/// corners stays, with an index repeated.
/// @throws EngineError(malformed_mesh) with the line or the byte, EngineError(too_many_vertices), EngineError(degenerate) as
/// read_mesh() does
[[nodiscard]] PolygonMesh read_stl(std::string_view text, const ReadLimits& limits = {});

}  // namespace spherematch
