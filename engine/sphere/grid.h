// The equirectangular grid on the unit sphere: N rows of colatitude by N columns of longitude, polar axis z.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "engine/data/tri_mesh.h"

namespace spherematch {

/// Values at the N x N cells: row j spans colatitudes [pi j / N, pi (j + 1) / N], column i longitudes
/// [2 pi i / N, 2 pi (i + 1) / N]. Cell values stand at cell centres; no sample lies on a pole.
using Grid = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The point at a colatitude and longitude.
inline Eigen::Vector3d sphere_point(double colatitude, double longitude) {
  const double s = std::sin(colatitude);
  return {s * std::cos(longitude), s * std::sin(longitude), std::cos(colatitude)};
}

/// The N * N cell centres, row by row.
inline Points cell_centers(int resolution) {
  Points centers(static_cast<Eigen::Index>(resolution) * resolution, 3);
  for (int j = 0; j < resolution; ++j)
    for (int i = 0; i < resolution; ++i)
      centers.row(static_cast<Eigen::Index>(j) * resolution + i) =
          sphere_point(std::numbers::pi * (j + 0.5) / resolution, 2 * std::numbers::pi * (i + 0.5) / resolution);
  return centers;
}

/// Solid angle of a cell in each row, (N).
inline Eigen::VectorXd cell_areas(int resolution) {
  Eigen::VectorXd areas(resolution);
  for (int j = 0; j < resolution; ++j)
    areas[j] = 2 * std::numbers::pi / resolution *
               (std::cos(std::numbers::pi * j / resolution) - std::cos(std::numbers::pi * (j + 1) / resolution));
  return areas;
}

}  // namespace spherematch
