// Mesh files in: the one entry for every format, recognised by content, then by name. Safe on untrusted bytes.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "engine/data/parameters.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

/// Reads a mesh from the bytes of a file. `name` is the file's name, for formats that the content does not tell; it may be
/// empty. Memory stays within a small multiple of bytes.size() and of what limits.max_vertices allow; for the JSON of glTF add 64 MiB.
/// No other file is opened. Thread-safe.
/// @throws EngineError(malformed_mesh) with the line, the byte, or the part of a glTF file; EngineError(unsupported_format);
/// EngineError(compressed_geometry), EngineError(external_reference) of glTF files;
/// EngineError(too_many_vertices) when the mesh has more vertices than limits.max_vertices or more than 12 polygon corners for each
/// of the vertices that the limit allows; EngineError(degenerate) when it has no vertices or no faces
[[nodiscard]] PolygonMesh read_mesh(std::span<const std::byte> bytes, std::string_view name, const ReadLimits& limits = {});

/// The format that read_mesh() takes such a file for: "ply", "glb", "gltf", "off", "stl" or "obj", and empty when it is none. The same
/// file is taken for the same format again under the name "." + the result. Thread-safe.
[[nodiscard]] std::string_view mesh_format_of(std::span<const std::byte> bytes, std::string_view name);

}  // namespace spherematch
