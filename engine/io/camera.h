// From where the two shapes of a picture are seen. Internal to engine/io.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/data/tri_mesh.h"

namespace spherematch {

/// Rows: right, up, toward the viewer. A rotation.
using ViewAxes = Eigen::Matrix3d;

/// Which way a shape stands, and from where to see it: unit vectors, at least 45 degrees apart.
struct Pose {
  Eigen::Vector3d up;
  Eigen::Vector3d front;
};

/// Seen along the direction in which the surface extends least, from a little to the side. Up is y or z, as files have it: the one
/// across that direction, and where both are, the one along which the shape stands on its lowest points. Coordinates must be of
/// moderate size.
[[nodiscard]] Pose upright_pose(const TriMesh& mesh);

/// The pose of a shape whose points, turned by `rotation`, lie best on those of a shape in `pose`. Its own coordinate axis near the
/// upward direction takes its place, so that it stands upright as well.
[[nodiscard]] Pose corresponding_pose(const Pose& pose, const Eigen::Matrix3d& rotation);

/// The rotation that takes points of `from` nearest to those of `to` in the mean over rows, weighted (Kabsch 1976). Rows that are
/// NaN or of weight zero are left out. The identity where less than three points in general position are left.
[[nodiscard]] Eigen::Matrix3d best_rotation(const Points& from, const Points& to, const Eigen::VectorXd& weights);

/// A view from a little above, in which up is vertical, and otherwise from the front.
[[nodiscard]] ViewAxes view_axes(const Pose& pose);

}  // namespace spherematch
