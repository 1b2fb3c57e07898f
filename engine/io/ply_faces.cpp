#include "engine/io/ply_faces.h"

#include <algorithm>
#include <cstdint>

#include "engine/io/number_output.h"

namespace spherematch {

namespace {

bool has_small_polygons(const PolygonMesh& mesh) {
  std::size_t corners = 0;
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) corners = std::max(corners, mesh.face(f).size());
  return corners <= 255;
}

template <typename Count>
void append_rows(std::string& bytes, const PolygonMesh& mesh) {
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    append_bytes(bytes, static_cast<Count>(face.size()));
    bytes.append(reinterpret_cast<const char*>(face.data()), face.size_bytes());
  }
}

}  // namespace

std::string ply_face_header(const PolygonMesh& mesh) {
  return "element face " + std::to_string(mesh.face_count()) + "\nproperty list " + (has_small_polygons(mesh) ? "uchar" : "int") +
         " int vertex_indices\nend_header\n";
}

std::size_t ply_faces_size(const PolygonMesh& mesh) {
  return static_cast<std::size_t>(mesh.face_count()) * (has_small_polygons(mesh) ? 1 : 4) + mesh.indices.size() * 4;
}

void append_ply_faces(std::string& bytes, const PolygonMesh& mesh) {
  has_small_polygons(mesh) ? append_rows<std::uint8_t>(bytes, mesh) : append_rows<std::int32_t>(bytes, mesh);
}

}  // namespace spherematch
