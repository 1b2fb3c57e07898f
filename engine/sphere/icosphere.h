// Nearly uniform triangulations of the sphere.
#pragma once

#include "engine/data/tri_mesh.h"

namespace spherematch {

/// An icosahedron whose faces are split in four `subdivisions` times: 10 * 4^subdivisions + 2 unit vectors, faces outward. The nodes of a
/// coarser icosphere are the first of every finer one.
[[nodiscard]] TriMesh icosphere(int subdivisions);

}  // namespace spherematch
