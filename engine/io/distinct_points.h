// Points given corner by corner, numbered as vertices: equal ones once. Internal to engine/io.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/data/tri_mesh.h"

namespace spherematch {

/// Numbers points in the order of their first appearance. Coordinates must be finite; -0 equals 0. The numbers depend on nothing else:
/// the random key of the hash keeps a hostile file from making every point collide, and is never seen outside. Not thread-safe.
class DistinctPoints {
 public:
  DistinctPoints();

  /// The number of the point, and a new one when no equal point came before. Constant time on average, whatever the points.
  std::int32_t number_of(const std::array<double, 3>& point);

  [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(points_.size()); }
  [[nodiscard]] Points points() const;

 private:
  [[nodiscard]] std::size_t hash(const std::array<double, 3>& point) const;
  void grow();

  std::vector<std::array<double, 3>> points_;
  std::vector<std::int32_t> next_;   ///< per point: another one of its bucket, or -1
  std::vector<std::int32_t> first_;  ///< per bucket; a power of two of them, at least one for each point
  std::array<std::uint64_t, 7> key_{};
};

}  // namespace spherematch
