// A mesh as uploaded: polygons of any size over points, nothing repaired.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/tri_mesh.h"

namespace spherematch {

/// Readers guarantee: every coordinate is finite, every index is in [0, vertices.rows()), every polygon has at least three
/// corners, offsets starts at 0, rises and ends at indices.size(). Indices may repeat within a polygon.
struct PolygonMesh {
  Points vertices;                       ///< (n, 3), in uploaded order
  std::vector<std::int32_t> offsets{0};  ///< polygon f has the corners indices[offsets[f]] ... indices[offsets[f + 1] - 1]
  std::vector<std::int32_t> indices;

  [[nodiscard]] std::int32_t vertex_count() const { return static_cast<std::int32_t>(vertices.rows()); }
  [[nodiscard]] std::int32_t face_count() const { return static_cast<std::int32_t>(offsets.size()) - 1; }
  [[nodiscard]] std::span<const std::int32_t> face(std::int32_t f) const {
    const auto first = static_cast<std::size_t>(offsets[static_cast<std::size_t>(f)]);
    const auto last = static_cast<std::size_t>(offsets[static_cast<std::size_t>(f) + 1]);
    return std::span(indices).subspan(first, last - first);
  }
};

}  // namespace spherematch
