// Posing.
#pragma once

#include <span>

#include "samples/flesh.h"
#include "samples/surface_mesh.h"

namespace spherematch::samples {

/// The place of each rest point in a pose, by dual quaternion skinning. It depends on the rest point alone, so that every mesh of the rest
/// surface is posed alike; the same point gives the same bits.
[[nodiscard]] std::vector<Vec3> posed(const Flesh& flesh, std::span<const Turn> turns, const std::vector<Vec3>& rest);

}  // namespace spherematch::samples
