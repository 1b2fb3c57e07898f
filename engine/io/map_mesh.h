// A map as a coloured mesh: the uploaded source mesh, painted with where its vertices lie on the target.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "engine/data/correspondence.h"
#include "engine/data/evaluation.h"
#include "engine/data/surface.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

/// One colour per row, (n, 3): red, green, blue.
using Colors = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The colour of what has no image.
constexpr std::uint8_t neutral_gray = 128;

struct MapMesh {
  PolygonMesh mesh;         ///< the source as uploaded, n vertices
  Points images;            ///< (n, 3): the vertices' images on the target; NaN for a dropped vertex
  Colors colors;            ///< (n, 3): normalised coordinates of the images; neutral gray for a dropped vertex
  VertexQuality quality{};  ///< n each, for the PLY file; what it shall not have is empty
};

/// The images of the source's uploaded vertices, (n, 3), in the target's coordinates; NaN for a dropped vertex.
/// @throws std::invalid_argument when a corner is no vertex of the target or a dropped one
[[nodiscard]] Points image_points(const Correspondence& map, const Surface& target);

/// Points in the target's coordinates, scaled to [0, 1] on each axis by the bounding box of the target's uploaded vertices, without
/// the dropped ones: a stray piece far away does not take the colours from what was matched. On an axis without extent 0.5; NaN
/// stays NaN.
[[nodiscard]] Points normalized_coordinates(const Points& points, const Surface& target);

/// The colours of the target's own uploaded vertices, (n, 3), as paint_mesh() gives them to what is mapped there; neutral gray for a
/// dropped one.
[[nodiscard]] Colors own_colors(const Surface& target);

/// Without quality. `source` is the uploaded mesh whose vertices the map speaks of. Linear time and memory.
/// @throws std::invalid_argument when their numbers of vertices differ, and as image_points()
[[nodiscard]] MapMesh paint_mesh(PolygonMesh source, const Correspondence& map, const Surface& target);

// The files below depend on the mesh alone, byte for byte. Vertices stand in uploaded order. Numbers in PLY and GLB are float; where
// the mesh or the target lies so far from the origin that float would blur it, PLY has double and GLB puts the offset in its node.

/// Binary little-endian PLY with x y z, red green blue, tx ty tz (the image), confidence and distortion where they are given, always
/// float, and the polygons as uploaded.
[[nodiscard]] std::string encode_ply(const MapMesh& painted);

/// OBJ with a line `v x y z r g b` for each vertex, colours from 0 to 1, and the polygons as uploaded.
[[nodiscard]] std::string encode_obj(const MapMesh& painted);

/// glTF 2.0 in one binary file: one primitive with POSITION, NORMAL, COLOR_0 and the polygons triangulated.
[[nodiscard]] std::string encode_glb(const MapMesh& painted);

}  // namespace spherematch
