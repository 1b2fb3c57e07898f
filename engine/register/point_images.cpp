#include "engine/register/point_images.h"

#include <limits>
#include <string>

#include "engine/data/error.h"
#include "engine/mesh/closest_point.h"

namespace spherematch {
namespace {

Eigen::Vector3d uploaded_position(const Surface& surface, std::int32_t vertex) {
  return surface.mesh.vertices.row(surface.surface_vertex[static_cast<std::size_t>(vertex)]).transpose();
}

}  // namespace

PointImages::PointImages(const Correspondence& map, const Surface& source, const Surface& target)
    : map_(map), source_(source), target_(target) {}

PointImages::~PointImages() = default;

void PointImages::require_vertex(std::int32_t vertex) const {
  if (vertex < 0 || vertex >= source_.uploaded_vertices()) {
    throw EngineError(ErrorCode::invalid_parameter,
                      std::to_string(vertex) + " is no vertex of the source, which has " + std::to_string(source_.uploaded_vertices()));
  }
}

Eigen::Vector3d PointImages::position_of(const std::array<std::int32_t, 3>& corners, const std::array<double, 3>& bary) const {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) position += bary[k] * uploaded_position(target_, corners[k]);
  return position;
}

std::optional<PointImage> PointImages::of_vertex(std::int32_t vertex) const {
  require_vertex(vertex);
  const auto row = static_cast<Eigen::Index>(vertex);
  PointImage image;
  image.vertex = map_.vertex[static_cast<std::size_t>(vertex)];
  if (image.vertex < 0) return std::nullopt;
  for (std::size_t k = 0; k < 3; ++k) {
    image.corners[k] = map_.corners(row, static_cast<Eigen::Index>(k));
    image.bary[k] = static_cast<double>(map_.bary(row, static_cast<Eigen::Index>(k)));
  }
  image.position = position_of(image.corners, image.bary);
  return image;
}

std::optional<PointImage> PointImages::of_corners(const std::array<std::int32_t, 3>& corners, const std::array<double, 3>& bary) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    require_vertex(corners[k]);
    if (bary[k] == 0) continue;
    const auto image = of_vertex(corners[k]);
    if (!image || bary[k] == 1) return image;
    mean += bary[k] * image->position;
  }
  return nearest_to(mean);
}

std::optional<PointImage> PointImages::of_position(const Eigen::Vector3d& position) {
  if (!position.allFinite()) throw EngineError(ErrorCode::invalid_parameter, "a position must be finite");
  if (!on_source_) on_source_ = std::make_unique<const ClosestPoint>(source_);
  const SurfacePoint nearest = on_source_->query(position);
  const auto corners = source_.uploaded_corners.row(nearest.face);
  return of_corners({corners[0], corners[1], corners[2]}, nearest.weights);
}

PointImage PointImages::nearest_to(const Eigen::Vector3d& position) {
  if (!on_target_) on_target_ = std::make_unique<const ClosestPoint>(target_);
  const SurfacePoint nearest = on_target_->query(position);
  const auto corners = target_.uploaded_corners.row(nearest.face);
  PointImage image;
  image.corners = {corners[0], corners[1], corners[2]};
  image.bary = nearest.weights;
  image.position = position_of(image.corners, image.bary);
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t corner : image.corners) {
    const double distance = (uploaded_position(target_, corner) - image.position).squaredNorm();
    if (distance < least || (distance == least && corner < image.vertex)) {
      least = distance;
      image.vertex = corner;
    }
  }
  return image;
}

}  // namespace spherematch
