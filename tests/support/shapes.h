// Surfaces and prepared shapes that several test programs make from meshes.
#pragma once

#include <cstdint>
#include <cstring>
#include <numeric>

#include "engine/data/parameters.h"
#include "engine/data/surface.h"
#include "engine/engine.h"
#include "engine/mesh/repair.h"
#include "tests/support/meshes.h"

namespace spherematch::test {

/// A surface whose upload is the mesh itself.
inline Surface verbatim_surface(const TriMesh& mesh) {
  Surface surface;
  surface.mesh = mesh;
  surface.uploaded_corners = mesh.faces;
  surface.surface_vertex.resize(static_cast<std::size_t>(mesh.vertex_count()));
  std::iota(surface.surface_vertex.begin(), surface.surface_vertex.end(), 0);
  surface.uploaded_faces = static_cast<std::int32_t>(mesh.face_count());
  return surface;
}

/// Cheap parameters, for what does not depend on accuracy.
inline PreprocessParameters quick_preparation() {
  PreprocessParameters parameters;
  parameters.conformal_steps = 20;
  parameters.authalic_resolution = 64;
  parameters.authalic_steps = 20;
  parameters.eigenpairs = 60;
  parameters.signal_resolution = 32;
  return parameters;
}

inline PreprocessedShape quickly_prepared(const TriMesh& mesh) {
  return preprocess(repair(polygons(mesh), RepairMode::none), quick_preparation());
}

template <typename Matrix>
bool same_bytes(const Matrix& a, const Matrix& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(typename Matrix::Scalar)) == 0;
}

}  // namespace spherematch::test
