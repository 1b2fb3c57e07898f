// The equirectangular grid on the unit sphere: N rows of colatitude by N columns of longitude, polar axis z.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace spherematch {

/// Values at the N x N cells: row j spans colatitudes [pi j / N, pi (j + 1) / N], column i longitudes
/// [2 pi i / N, 2 pi (i + 1) / N]. Cell values stand at cell centres; no sample lies on a pole.
using Grid = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The point at a colatitude and longitude.
inline Eigen::Vector3d sphere_point(double colatitude, double longitude) {
  const double s = std::sin(colatitude);
  return {s * std::cos(longitude), s * std::sin(longitude), std::cos(colatitude)};
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
