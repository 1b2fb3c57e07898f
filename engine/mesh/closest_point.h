// The nearest point of the uploaded surface, for images that fall on a patch that repair added.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>

#include "engine/data/surface.h"

namespace spherematch {

/// Weights of the point of the triangle that is nearest to `point`: the foot on its plane when inside, else the best of its edges.
[[nodiscard]] std::array<double, 3> nearest_weights(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& point);

/// Searches the faces whose uploaded corners are all known. Keeps its own copy of what it needs. Queries are const and
/// thread-safe; the same query gives the same answer. Building is O(F log F), a query about O(log F).
class ClosestPoint {
 public:
  /// @throws EngineError(degenerate) when no face of the surface has three uploaded corners
  explicit ClosestPoint(const Surface& surface);
  ~ClosestPoint();
  ClosestPoint(ClosestPoint&&) noexcept;
  ClosestPoint& operator=(ClosestPoint&&) noexcept;

  /// `point` must be finite.
  [[nodiscard]] SurfacePoint query(const Eigen::Vector3d& point) const;

 private:
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace spherematch
