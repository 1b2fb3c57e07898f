#include "engine/register/mirror.h"

namespace spherematch {

Eigen::Matrix3d mirror_matrix() { return Eigen::Vector3d(1, -1, 1).asDiagonal(); }

Points mirrored_points(const Points& points) {
  Points result = points;
  result.col(1) *= -1;
  return result;
}

Triangles mirrored_faces(const Triangles& faces) {
  Triangles result(faces.rows(), 3);
  result << faces.col(0), faces.col(2), faces.col(1);
  return result;
}

Eigen::MatrixXf mirrored_grid(const Eigen::MatrixXf& grid) { return grid.rowwise().reverse(); }

Location mirrored_location(const Location& location) { return {location.face, {location.bary[0], location.bary[2], location.bary[1]}}; }

}  // namespace spherematch
