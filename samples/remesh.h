// Good triangles of a wanted size on an implicit surface (after Botsch and Kobbelt, "A Remeshing Approach to Multiresolution Modeling",
// 2004: split, collapse, flip, smooth).
#pragma once

#include <vector>

#include "samples/flesh.h"
#include "samples/surface_mesh.h"

namespace spherematch::samples {

/// Remeshes the surface of the flesh, starting from any closed mesh near it, to edges of `scale` times flesh.edge_length().
[[nodiscard]] Mesh remesh(const Flesh& flesh, const Mesh& start, double scale);

/// A mesh some of whose vertices are at given points.
struct PinnedMesh {
  Mesh mesh;
  std::vector<int> pinned;  ///< for each point the vertex that is there, exactly
};

/// Changes a mesh made by remesh() with the same scale so that every point of `points`, on the surface and further from the others than an
/// edge, is a vertex.
/// @throws std::invalid_argument when two points want the same vertex
[[nodiscard]] PinnedMesh remesh_with(const Flesh& flesh, const Mesh& start, double scale, const std::vector<Vec3>& points);

}  // namespace spherematch::samples
