// Where chosen points of the source lie on the target, by a map that is known at the vertices.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "engine/data/correspondence.h"
#include "engine/data/surface.h"

namespace spherematch {

class ClosestPoint;

/// A point of the target: weights in uploaded vertices, as a row of a Correspondence has them, and its place.
struct PointImage {
  std::int32_t vertex = -1;
  std::array<std::int32_t, 3> corners{};
  std::array<double, 3> bary{};
  Eigen::Vector3d position;
};

/// Keeps references to its arguments, which must outlive it. Used by one thread.
class PointImages {
 public:
  PointImages(const Correspondence& map, const Surface& source, const Surface& target);
  ~PointImages();
  PointImages(const PointImages&) = delete;
  PointImages& operator=(const PointImages&) = delete;

  // Nothing where a vertex that is asked for was dropped. @throws EngineError(invalid_parameter) for what is no vertex of the source

  /// Of an uploaded vertex: its row of the map.
  [[nodiscard]] std::optional<PointImage> of_vertex(std::int32_t vertex) const;
  /// Of the point with the given weights in three uploaded vertices: the point of the target nearest to the weighted mean of their images.
  [[nodiscard]] std::optional<PointImage> of_corners(const std::array<std::int32_t, 3>& corners, const std::array<double, 3>& bary);
  /// Of the point of the source nearest to a position. @throws EngineError(invalid_parameter) when it is not finite
  [[nodiscard]] std::optional<PointImage> of_position(const Eigen::Vector3d& position);

 private:
  void require_vertex(std::int32_t vertex) const;
  [[nodiscard]] Eigen::Vector3d position_of(const std::array<std::int32_t, 3>& corners, const std::array<double, 3>& bary) const;
  [[nodiscard]] PointImage nearest_to(const Eigen::Vector3d& position);

  const Correspondence& map_;
  const Surface& source_;
  const Surface& target_;
  std::unique_ptr<const ClosestPoint> on_source_;  ///< made when first needed
  std::unique_ptr<const ClosestPoint> on_target_;
};

}  // namespace spherematch
