// From the implicit surface to a first mesh.
#pragma once

#include "samples/flesh.h"
#include "samples/surface_mesh.h"

namespace spherematch::samples {

/// The zero level of the flesh on a grid of cubes of side `cell`, each cut into six tetrahedra: closed and manifold, its triangles of any
/// shape. `shift` in [0, 1) moves the grid by that part of a cell.
[[nodiscard]] Mesh march(const Flesh& flesh, double cell, double shift);

}  // namespace spherematch::samples
