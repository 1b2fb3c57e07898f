// Composition of the registered parametrisations into a dense map (paper section 3: source -> sphere -> target).
#pragma once

#include "engine/data/correspondence.h"
#include "engine/register/point_location.h"

namespace spherematch {

/// The place of each point (P, 3) on the target's sphere, found on up to `threads` threads.
[[nodiscard]] std::vector<Location> locate_all(const Points& points, const PointLocation& target, int threads = 1);

/// How far from where they started points come out that go there and back, by either map between its vertices: straight distances, in units
/// of the square root of the surface's area.
struct RoundTrip {
  double mean = 0;
  double largest = 0;
};

/// Of the vertices of source.mesh, whose locations in target.mesh are `there`; `back` are those of the vertices of target.mesh in
/// source.mesh.
[[nodiscard]] RoundTrip round_trip(const Surface& source, const Surface& target, const std::vector<Location>& there,
                                   const std::vector<Location>& back);

/// The map between uploads, from the locations of all vertices of source.mesh in target.mesh.
[[nodiscard]] Correspondence compose(const Surface& source, const Surface& target, const std::vector<Location>& locations);

}  // namespace spherematch
