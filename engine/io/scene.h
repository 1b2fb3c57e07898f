// A map as a scene: both meshes side by side, corresponding points in one colour.
#pragma once

#include <string>

#include "engine/data/correspondence.h"
#include "engine/data/surface.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

struct SceneNames {
  std::string source;
  std::string target;
};

/// glTF 2.0 in one binary file. Two nodes with these names (as UTF-8; other bytes are replaced): the source where it lies, painted as
/// paint_mesh() does, and the target to its right along x, its middle as high and as deep as the source's, painted with its own
/// coordinates. Between their boxes is a gap of a fifth of the larger one's longest side. Each has POSITION, NORMAL, COLOR_0 and its
/// polygons triangulated, vertices in uploaded order. The meshes are those that the map's shapes were uploaded as.
/// @throws std::invalid_argument when a mesh has another number of vertices than its shape, and as image_points()
[[nodiscard]] std::string encode_scene(PolygonMesh source, const PolygonMesh& target, const Correspondence& map,
                                       const Surface& target_surface, const SceneNames& names);

}  // namespace spherematch
