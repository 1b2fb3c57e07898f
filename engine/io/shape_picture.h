// A shape as a small picture.
#pragma once

#include <string>

#include "engine/io/polygon_mesh.h"

namespace spherematch {

inline constexpr int least_thumbnail = 16;
inline constexpr int largest_thumbnail = 1024;

/// PNG of size x size pixels, from least_thumbnail to largest_thumbnail: the mesh as uploaded, before any repair, in one colour on a
/// transparent background, so that it goes with light pages and with dark ones. Seen from where it is broad, as encode_png() sees a
/// source, and as large as fits; holes show the inside. The bytes depend on the arguments alone. Linear time; some 75 bytes for each
/// pixel and a few times the memory of the mesh. Thread-safe.
/// @throws std::invalid_argument for another size, or for a mesh without area
[[nodiscard]] std::string encode_thumbnail(const PolygonMesh& mesh, int size);

}  // namespace spherematch
