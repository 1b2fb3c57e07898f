// Adjacency of triangle meshes in flat arrays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/tri_mesh.h"

namespace spherematch {

/// The faces round each vertex, in rising order of face index.
struct VertexFaces {
  std::vector<std::int32_t> offsets;  ///< (V + 1)
  std::vector<std::int32_t> faces;    ///< (3 F): those of vertex v are faces[offsets[v]] ... faces[offsets[v + 1] - 1]

  [[nodiscard]] std::span<const std::int32_t> of(std::int32_t vertex) const {
    const auto first = static_cast<std::size_t>(offsets[static_cast<std::size_t>(vertex)]);
    const auto last = static_cast<std::size_t>(offsets[static_cast<std::size_t>(vertex) + 1]);
    return std::span(faces).subspan(first, last - first);
  }
};

/// Every index must be in [0, vertex_count). Linear time.
[[nodiscard]] VertexFaces vertex_faces(const Triangles& faces, Eigen::Index vertex_count);

/// (F, 3): entry (f, k) is the face across the edge from corner k to corner (k + 1) % 3 of face f, or -1 at a boundary.
/// @throws EngineError(non_manifold) when more than two faces share an edge, or two that run along it the same way
[[nodiscard]] Triangles face_neighbours(const Triangles& faces);

/// Vertices - edges + faces, where an edge is an unordered pair of vertices that a face has. Counts only vertices with a face.
[[nodiscard]] std::int64_t euler_characteristic(const Triangles& faces);

}  // namespace spherematch
