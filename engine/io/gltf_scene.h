// From a loaded glTF model to the polygons of its default scene. Internal to engine/io.
#pragma once

#include "engine/data/parameters.h"
#include "engine/io/polygon_mesh.h"

namespace tinygltf {
class Model;
}

namespace spherematch {

/// As read_gltf() does. The model may hold anything that tinygltf lets pass.
/// @throws EngineError(malformed_mesh) naming the node, mesh or accessor, EngineError(too_many_vertices), EngineError(degenerate)
[[nodiscard]] PolygonMesh read_gltf_scene(const tinygltf::Model& model, const ReadLimits& limits);

}  // namespace spherematch
