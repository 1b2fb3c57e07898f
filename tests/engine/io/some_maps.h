// Small maps for the tests of what is written about them.
#pragma once

#include "engine/data/correspondence.h"
#include "engine/data/surface.h"
#include "engine/io/map_mesh.h"
#include "engine/io/polygon_mesh.h"
#include "engine/mesh/repair.h"
#include "tests/support/meshes.h"

namespace spherematch::test {

/// Every uploaded vertex of the surface goes to itself; dropped ones to nothing.
inline Correspondence identity_map(const Surface& surface) {
  const Eigen::Index n = surface.uploaded_vertices();
  Correspondence map;
  map.vertex.assign(static_cast<std::size_t>(n), -1);
  map.corners.setConstant(n, 3, -1);
  map.bary.setZero(n, 3);
  for (Eigen::Index f = 0; f < surface.uploaded_corners.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t v = surface.uploaded_corners(f, k);
      if (surface.uploaded_corners.row(f).minCoeff() < 0) continue;
      map.vertex[static_cast<std::size_t>(v)] = v;
      map.corners.row(v) = surface.uploaded_corners.row(f);
      map.bary.row(v) = Eigen::RowVector3f::Unit(k);
    }
  }
  return map;
}

/// A sphere of 162 vertices, and after them a tetrahedron far away that repair drops.
inline PolygonMesh sphere_and_stray() {
  return polygons(joined(icosphere(2), transformed(tetrahedron(), 0.1, Eigen::Matrix3d::Identity(), Eigen::Vector3d(50, 0, 0))));
}

/// The mesh, repaired, mapped to itself.
inline MapMesh painted_identity(const PolygonMesh& mesh) {
  const Surface surface = repair(mesh, RepairMode::fill);
  return paint_mesh(mesh, identity_map(surface), surface);
}

}  // namespace spherematch::test
