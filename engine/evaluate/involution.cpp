#include "engine/evaluate/involution.h"

#include <algorithm>
#include <cmath>

#include "engine/mesh/laplacian.h"

namespace spherematch {

namespace {

/// The weighted mean, for each uploaded vertex, of the rows that belong to the corners of its image; not-a-number for a dropped one.
Points carried(const Correspondence& map, const Points& rows) {
  Points result = Points::Constant(map.corners.rows(), 3, std::nan(""));
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    if (map.vertex[static_cast<std::size_t>(i)] < 0) continue;
    result.row(i).setZero();
    for (int k = 0; k < 3; ++k) result.row(i) += static_cast<double>(map.bary(i, k)) * rows.row(map.corners(i, k));
  }
  return result;
}

}  // namespace

InvolutionResidual involution_residual(const Correspondence& map, const Surface& surface) {
  const Eigen::VectorXd areas = vertex_areas(surface.mesh.vertices, surface.mesh.faces);
  Points places = Points::Constant(surface.uploaded_vertices(), 3, std::nan(""));
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(places.rows());
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const std::int32_t vertex = surface.surface_vertex[static_cast<std::size_t>(i)];
    if (vertex < 0) continue;
    places.row(i) = surface.mesh.vertices.row(vertex);
    weights[i] = areas[vertex];
  }
  const Points twice = carried(map, carried(map, places));
  InvolutionResidual result;
  double weight = 0;
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const double distance = (twice.row(i) - places.row(i)).norm();
    if (!std::isfinite(distance)) continue;
    result.mean += weights[i] * distance;
    result.max = std::max(result.max, distance);
    weight += weights[i];
  }
  const double unit = std::sqrt(areas.sum());
  if (weight > 0) result.mean /= weight * unit;
  result.max /= unit;
  return result;
}

}  // namespace spherematch
