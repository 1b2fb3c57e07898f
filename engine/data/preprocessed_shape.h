// Everything that preprocessing computes of one shape; immutable once made, and what the store keeps.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/data/surface.h"

namespace spherematch {

/// Name and wall-clock seconds of each stage, in order of start.
using StageSeconds = std::vector<std::pair<std::string, double>>;

struct SphereQuality {
  std::int32_t flipped = 0;       ///< spherical triangles whose exact orientation test is not positive
  double solid_angle_defect = 0;  ///< |sum of signed solid angles - 4 pi|
  double area_distortion = 0;     ///< area-weighted mean of |log(spherical area / surface area)|, both of total 1
};

/// A signal of the surface pulled back to the sphere: mean over each cell of an equirectangular grid (engine/sphere/grid.h).
struct SignalGrid {
  std::string name;        ///< for example "hks_0.0625"
  Eigen::MatrixXf values;  ///< (N, N): row = colatitude, column = longitude
};

/// Name of the heat kernel signature at a time, "hks_0.0625".
[[nodiscard]] std::string hks_name(double time);

/// Names of the signals that are the coordinates of the surface, scaled to unit area.
inline constexpr std::array<const char*, 3> position_signal_names{"position_x", "position_y", "position_z"};

struct PreprocessedShape {
  Surface surface;
  Points sphere;  ///< (V, 3) unit vectors, one per vertex of surface.working_mesh(); no flipped triangle
  SphereQuality sphere_quality;
  Eigen::VectorXd eigenvalues;   ///< (k), ascending, of the surface scaled to unit area
  Eigen::MatrixXf eigenvectors;  ///< (V, k), unit mass norm on the unit-area surface
  std::vector<SignalGrid> signals;
  StageSeconds seconds;  ///< "conformal", "authalic", "eigenbasis", ..., "total"
  std::string engine;    ///< engine_version() that made it
};

/// From positions of the vertices of surface.working_mesh() on the sphere to those of the vertices of surface.mesh.
[[nodiscard]] Points spread_over(const Surface& surface, const Points& working_sphere);

/// The position of each uploaded vertex on the sphere, (n, 3); not-a-number for a dropped one.
[[nodiscard]] Points uploaded_sphere(const PreprocessedShape& shape);

}  // namespace spherematch
