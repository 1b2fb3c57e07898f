// Composition of the registered parametrisations into a dense map (paper section 3: source -> sphere -> target).
#pragma once

#include "engine/data/correspondence.h"
#include "engine/register/point_location.h"

namespace spherematch {

/// For each vertex of the source sphere its place on the target sphere, both registered; on the surfaces' own numbering.
/// Exchanging the arguments gives the inverse of the same piecewise map.
[[nodiscard]] std::vector<Location> locate_all(const Points& source_sphere, const PointLocation& target);

/// The map between uploads, from the locations of all vertices of source.mesh in target.mesh.
[[nodiscard]] Correspondence compose(const Surface& source, const Surface& target, const std::vector<Location>& locations);

}  // namespace spherematch
