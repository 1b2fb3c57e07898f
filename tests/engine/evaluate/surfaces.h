// Surfaces and maps with known answers, for the tests of measures.
#pragma once

#include <cmath>
#include <vector>

#include "engine/data/correspondence.h"
#include "engine/data/surface.h"
#include "engine/mesh/repair.h"
#include "tests/support/meshes.h"

namespace spherematch::test {

inline Surface surface_of(const TriMesh& mesh) { return repair(polygons(mesh), RepairMode::fill); }

/// Vertex i goes to vertex targets[i] of the mesh, at a corner of some face; -1 for no image.
inline Correspondence vertex_map(const std::vector<std::int32_t>& targets, const TriMesh& target) {
  std::vector<Eigen::RowVector3i> face_of(static_cast<std::size_t>(target.vertex_count()));
  for (const auto& face : target.faces.rowwise()) {
    for (int k = 0; k < 3; ++k) face_of[static_cast<std::size_t>(face[k])] << face[k], face[(k + 1) % 3], face[(k + 2) % 3];
  }
  Correspondence map;
  map.vertex = targets;
  map.corners.setConstant(static_cast<Eigen::Index>(targets.size()), 3, -1);
  map.bary.setZero(static_cast<Eigen::Index>(targets.size()), 3);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (targets[i] < 0) continue;
    map.corners.row(static_cast<Eigen::Index>(i)) = face_of[static_cast<std::size_t>(targets[i])];
    map.bary(static_cast<Eigen::Index>(i), 0) = 1;
  }
  return map;
}

inline std::vector<std::int32_t> numbers_to(Eigen::Index count) {
  std::vector<std::int32_t> numbers;
  for (std::int32_t i = 0; i < count; ++i) numbers.push_back(i);
  return numbers;
}

inline Correspondence identity_map(const TriMesh& mesh) { return vertex_map(numbers_to(mesh.vertex_count()), mesh); }

}  // namespace spherematch::test
