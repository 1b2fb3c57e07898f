// The element `face` of the PLY files that are written. Internal to engine/io.
#pragma once

#include <string>

#include "engine/io/polygon_mesh.h"

namespace spherematch {

/// The header's lines about the faces, and its end.
[[nodiscard]] std::string ply_face_header(const PolygonMesh& mesh);

/// The bytes of append_ply_faces().
[[nodiscard]] std::size_t ply_faces_size(const PolygonMesh& mesh);

/// Little-endian rows: the number of corners, one byte where that does for every polygon, and the corners as int.
void append_ply_faces(std::string& bytes, const PolygonMesh& mesh);

}  // namespace spherematch
