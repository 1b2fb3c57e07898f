// Rasterisation of a spherical triangulation on the equirectangular grid (paper section 4.1).
//
// Every triangle is cut by the meridians and parallels of the grid; each piece gives its cell the share of the triangle that
// it covers, so that what is deposited adds up exactly.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/data/tri_mesh.h"
#include "engine/sphere/grid.h"

namespace spherematch {

/// The part of a face that lies in one cell.
struct RasterPiece {
  Eigen::Index cell;  ///< row * N + column
  Eigen::Index face;
  double share;              ///< fraction of the face's area; the shares of a face sum to 1
  Eigen::Vector3d centroid;  ///< barycentric coordinates of the piece's centroid in the face
};

/// Spreads `face_mass` (F) over the cells that each face covers. The sum of the result is the sum of the masses.
[[nodiscard]] Grid rasterize_mass(const Points& sphere, const Triangles& faces, const Eigen::VectorXd& face_mass, int resolution);

/// Mean over each cell of a piecewise linear function given at the vertices, for each column of `values` (V, C).
/// A cell that no triangle reaches takes the value of its neighbours, so the result is finite.
[[nodiscard]] std::vector<Grid> rasterize_signals(const Points& sphere, const Triangles& faces, const Eigen::MatrixXd& values,
                                                  int resolution);

}  // namespace spherematch
