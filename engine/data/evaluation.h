// Ground truth, and how far a map is from it.
#pragma once

#include <cstdint>

namespace spherematch {

/// Uploaded vertex `source` of one shape belongs to uploaded vertex `target` of the other.
struct Landmark {
  std::int32_t source = 0;
  std::int32_t target = 0;
};

/// Geodesic distances between images and truth, divided by the square root of the target's area. All zero when nothing was scored.
struct MapError {
  double mean = 0;
  double median = 0;
  double p95 = 0;
  double max = 0;
  std::int32_t scored = 0;    ///< landmarks that the figures are about
  std::int32_t unscored = 0;  ///< landmarks at a dropped vertex of either shape
};

}  // namespace spherematch
