// Reflection in the plane y = 0. All that preprocessing knows of a shape's mirror image follows from what it knows of the shape:
// eigenvalues, eigenvectors and areas are the same, the sphere is reflected, and faces are turned round to face outward again.
#pragma once

#include <Eigen/Core>

#include "engine/data/tri_mesh.h"
#include "engine/register/point_location.h"

namespace spherematch {

/// diag(1, -1, 1).
[[nodiscard]] Eigen::Matrix3d mirror_matrix();

[[nodiscard]] Points mirrored_points(const Points& points);

/// Faces with their second and third corner exchanged, in the same order.
[[nodiscard]] Triangles mirrored_faces(const Triangles& faces);

/// An equirectangular grid (engine/sphere/grid.h) of the reflected function: longitudes change their sign, so columns change ends.
[[nodiscard]] Eigen::MatrixXf mirrored_grid(const Eigen::MatrixXf& grid);

/// The same point, located in mirrored_faces() or back again.
[[nodiscard]] Location mirrored_location(const Location& location);

}  // namespace spherematch
