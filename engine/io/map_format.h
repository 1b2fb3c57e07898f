// Every format of a map by its name: one list for the server's `format` parameter and the command's file extensions.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/data/correspondence.h"
#include "engine/data/evaluation.h"
#include "engine/data/surface.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

enum class MapFormat { npz, npy, text, list_from_one, ply, glb, obj, png };

/// "npz", "npy", "txt", "map", "ply", "glb", "obj", "png": in this order.
[[nodiscard]] std::vector<std::string_view> map_format_names();

/// Nothing for another name; capitals are another name.
[[nodiscard]] std::optional<MapFormat> map_format_of(std::string_view name);

/// Whether encode_map() needs the source as it was uploaded.
[[nodiscard]] bool needs_source_mesh(MapFormat format);

/// Whether encode_map() needs the two surfaces.
[[nodiscard]] bool needs_surfaces(MapFormat format);

/// Whether the file has room for confidence and distortion beside the map.
[[nodiscard]] bool holds_quality(MapFormat format);

/// The file's bytes; they depend on the arguments alone. `source_mesh` is the uploaded mesh that `source` was made of. What is not
/// needed may be empty, and arrays of `quality` that are empty are left out. Thread-safe.
/// @throws std::invalid_argument when the source and the map differ in their number of vertices, or the map goes to vertices that the
/// target does not have
[[nodiscard]] std::string encode_map(MapFormat format, const Correspondence& map, const Surface& source, const Surface& target,
                                     PolygonMesh source_mesh = {}, VertexQuality quality = {});

}  // namespace spherematch
