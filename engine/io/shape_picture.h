// A shape as a small picture.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "engine/io/polygon_mesh.h"

namespace spherematch {

inline constexpr int least_thumbnail = 16;
inline constexpr int largest_thumbnail = 1024;

/// From where to look, in the mesh's coordinates: unit vectors, not along one line. A shape is seen from a little above `front`.
struct Viewpoint {
  Eigen::Vector3d up;
  Eigen::Vector3d front;
};

/// PNG of size x size pixels, from least_thumbnail to largest_thumbnail: the mesh as uploaded, before any repair, in one colour on a
/// transparent background, so that it goes with light pages and with dark ones. Without a viewpoint it is seen from
/// where it is broad, as encode_png() sees a source. It is as large as fits; holes show the inside. The bytes depend on the arguments
/// alone. Linear time; some 75 bytes for each pixel and a few times the memory of the mesh. Thread-safe.
/// @throws std::invalid_argument for another size, or for a mesh without area
[[nodiscard]] std::string encode_thumbnail(const PolygonMesh& mesh, int size, const std::optional<Viewpoint>& view = {});

}  // namespace spherematch
