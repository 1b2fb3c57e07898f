#include "engine/data/preprocessed_shape.h"

#include <cstdio>
#include <limits>

namespace spherematch {

std::string hks_name(double time) {
  char name[40];
  std::snprintf(name, sizeof name, "hks_%g", time);
  return name;
}

Points spread_over(const Surface& surface, const Points& working_sphere) {
  if (!surface.decimated) return working_sphere;
  const auto& [mesh, places, seconds] = *surface.decimated;
  Points sphere = Points::Zero(static_cast<Eigen::Index>(places.size()), 3);
  for (Eigen::Index v = 0; v < sphere.rows(); ++v) {
    const SurfacePoint& place = places[static_cast<std::size_t>(v)];
    for (std::size_t k = 0; k < 3; ++k)
      sphere.row(v) += place.weights[k] * working_sphere.row(mesh.faces(place.face, static_cast<Eigen::Index>(k)));
    const double length = sphere.row(v).norm();
    if (length > 0) {
      sphere.row(v) /= length;
    } else {  // the middle of a face that spans a hemisphere
      sphere.row(v) = working_sphere.row(mesh.faces(place.face, 0));
    }
  }
  return sphere;
}

Points uploaded_sphere(const PreprocessedShape& shape) {
  const Points sphere = spread_over(shape.surface, shape.sphere);
  const std::vector<std::int32_t>& vertex = shape.surface.surface_vertex;
  Points points(static_cast<Eigen::Index>(vertex.size()), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const std::int32_t v = vertex[static_cast<std::size_t>(i)];
    if (v < 0) {
      points.row(i).setConstant(std::numeric_limits<double>::quiet_NaN());
    } else {
      points.row(i) = sphere.row(v);
    }
  }
  return points;
}

}  // namespace spherematch
