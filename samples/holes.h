// A mesh with pieces missing, as scans have them.
#pragma once

#include <vector>

#include "samples/landmarks.h"
#include "samples/surface_mesh.h"

namespace spherematch::samples {

/// Which vertices and triangles of a closed mesh are left.
struct Cut {
  std::vector<int> kept;        ///< vertices, ascending: vertex i of the cut mesh is vertex kept[i] of the whole one
  std::vector<int> new_number;  ///< of each vertex of the whole mesh, -1 where it is gone
  std::vector<Triangle> triangles;
};

/// Takes away the triangles with a corner in one of the balls, and the vertices that no triangle is left of.
[[nodiscard]] Cut cut_holes(const Mesh& mesh, const std::vector<Ball>& balls);

}  // namespace spherematch::samples
