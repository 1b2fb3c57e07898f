// Polygons as triangles and their normals, for the writers of formats that have triangles only. Internal to engine/io.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/io/polygon_mesh.h"

namespace spherematch {

/// Three vertices for each triangle, the polygons in order. A polygon is cut into the fan that keeps its worst triangle most upright,
/// so that one reflex corner does not fold it over. `positions` may differ from the mesh's vertices by an offset and a scale.
[[nodiscard]] std::vector<std::uint32_t> fan_triangles(const PolygonMesh& mesh, const Points& positions);

/// Area-weighted vertex normals of unit length, (n, 3), as float; (0, 0, 1) for a vertex that no face gives a direction.
using Floats = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
[[nodiscard]] Floats vertex_normals(const PolygonMesh& mesh, const Points& positions);

}  // namespace spherematch
