// Mesh files out: an uploaded mesh in another format.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/io/polygon_mesh.h"

namespace spherematch {

enum class MeshFormat { off, obj, ply, stl, glb };

/// "off", "obj", "ply", "stl", "glb"; nothing for another name.
[[nodiscard]] std::optional<MeshFormat> mesh_format_named(std::string_view name);

/// The file's bytes; they depend on the mesh alone. Vertices stand in uploaded order, but for STL, which has none. Thread-safe.
/// - OFF, OBJ: text, numbers in their shortest form that reads back to the same double; polygons as they are.
/// - PLY: binary little-endian, float where that holds every coordinate exactly, else double; polygons as they are. Alone among the
///   formats it may have coordinates that are NaN.
/// - STL: binary, polygons triangulated; text with doubles where float would blur the mesh.
/// - GLB: as GlbFile::add(), polygons triangulated, normals, no colours.
[[nodiscard]] std::string encode_mesh(MeshFormat format, const PolygonMesh& mesh);

}  // namespace spherematch
