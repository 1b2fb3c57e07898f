// What preprocessing made of a shape, as files that speak of the uploaded vertices.
#pragma once

#include <string>

#include "engine/data/preprocessed_shape.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

/// PLY of the uploaded mesh with its vertices on the sphere, in double; NaN for a dropped vertex.
/// @throws std::invalid_argument when the mesh has another number of vertices than the shape
[[nodiscard]] std::string encode_sphere_ply(PolygonMesh uploaded, const PreprocessedShape& shape);

/// The heat kernel signatures pulled back to the sphere, as NPY: float32 (T, N, N), row = colatitude, column = longitude.
/// @throws std::invalid_argument when the shape's grids differ in size
[[nodiscard]] std::string encode_hks_npy(const PreprocessedShape& shape);

/// NPZ of `times`, float64 (T,), and `grids`, the array of encode_hks_npy().
[[nodiscard]] std::string encode_hks_npz(const PreprocessedShape& shape);

}  // namespace spherematch
