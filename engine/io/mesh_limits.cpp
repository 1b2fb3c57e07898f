#include "engine/io/mesh_limits.h"

#include <algorithm>
#include <limits>

namespace spherematch {

MeshLimits::MeshLimits(const ReadLimits& limits)
    : vertices_(std::min<std::int64_t>(limits.max_vertices, std::numeric_limits<std::int32_t>::max() / corners_per_vertex)) {}

void MeshLimits::refuse_vertices(std::int64_t count) const {
  throw EngineError(ErrorCode::too_many_vertices,
                    "the mesh has " + std::to_string(count) + " vertices; the limit is " + std::to_string(vertices_));
}

void MeshLimits::refuse_corners(const std::string& place) const {
  throw EngineError(ErrorCode::too_many_vertices, place + "the faces have more than " + std::to_string(corners()) + " corners");
}

void check_not_empty(std::int64_t vertices, std::int64_t faces) {
  if (vertices == 0 || faces == 0) throw EngineError(ErrorCode::degenerate, "the mesh has no vertices or no faces");
}

}  // namespace spherematch
