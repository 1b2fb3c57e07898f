// A map as a picture: both shapes side by side, corresponding points in the same colour.
#pragma once

#include <string>

#include "engine/data/correspondence.h"
#include "engine/data/surface.h"
#include "engine/io/vertex_data.h"

namespace spherematch {

/// PNG of 1200 x 600 pixels: the source on the left, the target on the right, each scaled by its area, on white. A point of the target
/// has its normalised coordinates as its colour, a point of the source the colour of its image; what has no image is gray. The source is
/// seen from the side where it is broad, the target from the corresponding side. The bytes depend on the arguments alone. Takes some
/// 30 MB and, for the time of the call, a few times the memory of both meshes.
/// @throws std::invalid_argument when map and source differ in their number of vertices, and as image_points()
[[nodiscard]] std::string encode_png(const Correspondence& map, const Surface& source, const Surface& target);

/// The same picture in the colours of what is known at the vertices of both: what was carried along the map on the source, what it was
/// carried from on the target. Texture coordinates are shown by a checkerboard.
/// @throws std::invalid_argument when data and surface differ in their number of vertices, and as above
[[nodiscard]] std::string encode_png(const VertexDataPair& data, const Correspondence& map, const Surface& source, const Surface& target);

}  // namespace spherematch
