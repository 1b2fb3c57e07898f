// How far a map of a surface to itself is from undoing itself when it is applied twice, as every bilateral symmetry does.
#pragma once

#include "engine/data/correspondence.h"
#include "engine/data/surface.h"

namespace spherematch {

/// Straight distances in space between surface vertices p and map(map(p)), divided by the square root of the surface's area. The image of
/// a point within a face is the weighted mean of the images of its corners.
struct InvolutionResidual {
  double mean = 0;  ///< over the surface's area
  double max = 0;
};

/// Of a map from the surface to itself. Added vertices and those whose image is not known are left out; all zero when none is left.
/// Thread-safe, deterministic.
[[nodiscard]] InvolutionResidual involution_residual(const Correspondence& map, const Surface& surface);

}  // namespace spherematch
