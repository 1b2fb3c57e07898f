// glTF 2.0, as JSON with data URIs and as binary GLB: the triangles of the default scene.
// https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
#pragma once

#include <string_view>

#include "engine/data/parameters.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

/// True for the signature of GLB, and for text that starts with a brace, as that of no other mesh format does.
[[nodiscard]] bool is_gltf(std::string_view text);

/// The vertices are the POSITION values of all primitives made of triangles, strips or fans, in the order of the scene: nodes depth
/// first, each node's mesh before its children, a mesh once for each node that has it. Node transforms are applied; one that mirrors
/// turns the faces round. Skins, morph targets and animations are not applied; images and materials are not looked at. The scene is
/// the default one, else the first, else all nodes without a parent. No file is ever opened and no address fetched.
/// @throws EngineError(malformed_mesh) with the byte, or naming the node, mesh or accessor,
/// EngineError(unsupported_format) for other versions and for extensions that the file requires,
/// EngineError(compressed_geometry), EngineError(external_reference) for a buffer outside of the file,
/// EngineError(too_many_vertices), EngineError(degenerate) as read_mesh() does
[[nodiscard]] PolygonMesh read_gltf(std::string_view text, const ReadLimits& limits = {});

}  // namespace spherematch
