#include "engine/io/map_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace spherematch {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The place of an uploaded vertex.
auto uploaded_point(const Surface& surface, std::int32_t vertex) {
  const std::int32_t place =
      vertex < 0 || vertex >= surface.uploaded_vertices() ? -1 : surface.surface_vertex[static_cast<std::size_t>(vertex)];
  if (place < 0) throw std::invalid_argument("the map goes to vertex " + std::to_string(vertex) + ", which has no place on the target");
  return surface.mesh.vertices.row(place);
}

std::uint8_t byte_of(double normalized) {
  return std::isnan(normalized) ? neutral_gray : static_cast<std::uint8_t>(std::lround(255 * normalized));
}

}  // namespace

Points image_points(const Correspondence& map, const Surface& target) {
  Points images(map.corners.rows(), 3);
  for (Eigen::Index i = 0; i < images.rows(); ++i) {
    if (map.corners(i, 0) < 0) {
      images.row(i).setConstant(not_a_number);
      continue;
    }
    images.row(i).setZero();
    for (int k = 0; k < 3; ++k) images.row(i) += static_cast<double>(map.bary(i, k)) * uploaded_point(target, map.corners(i, k));
  }
  return images;
}

Points normalized_coordinates(const Points& points, const Surface& target) {
  Eigen::RowVector3d low = Eigen::RowVector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::RowVector3d high = -low;
  for (std::int32_t v = 0; v < target.uploaded_vertices(); ++v) {
    if (target.surface_vertex[static_cast<std::size_t>(v)] < 0) continue;
    low = low.cwiseMin(uploaded_point(target, v));
    high = high.cwiseMax(uploaded_point(target, v));
  }
  Points normalized(points.rows(), 3);
  for (int k = 0; k < 3; ++k) {
    const double extent = high(k) - low(k);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const double value = extent > 0 ? (points(i, k) - low(k)) / extent : 0.5;
      normalized(i, k) = std::isnan(points(i, k)) ? not_a_number : std::clamp(value, 0.0, 1.0);
    }
  }
  return normalized;
}

Colors own_colors(const Surface& target) {
  Points points(target.uploaded_vertices(), 3);
  for (std::int32_t v = 0; v < target.uploaded_vertices(); ++v) {
    const bool dropped = target.surface_vertex[static_cast<std::size_t>(v)] < 0;
    points.row(v) = dropped ? Eigen::RowVector3d::Constant(not_a_number) : Eigen::RowVector3d(uploaded_point(target, v));
  }
  return normalized_coordinates(points, target).unaryExpr(&byte_of);
}

MapMesh paint_mesh(PolygonMesh source, const Correspondence& map, const Surface& target) {
  if (source.vertices.rows() != map.corners.rows()) {
    throw std::invalid_argument("the map has " + std::to_string(map.corners.rows()) + " vertices and its source mesh " +
                                std::to_string(source.vertices.rows()));
  }
  MapMesh painted{.mesh = std::move(source), .images = image_points(map, target), .colors = {}};
  painted.colors = normalized_coordinates(painted.images, target).unaryExpr(&byte_of);
  return painted;
}

}  // namespace spherematch
