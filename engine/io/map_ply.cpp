// Internal layout of the file: a text header, then one record for each vertex and each polygon.
#include <algorithm>
#include <bit>
#include <cstddef>

#include "engine/io/float_range.h"
#include "engine/io/map_mesh.h"

namespace spherematch {

namespace {

static_assert(std::endian::native == std::endian::little, "the header below promises little-endian numbers");

template <typename Number>
void append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

std::int32_t largest_polygon(const PolygonMesh& mesh) {
  std::size_t corners = 0;
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) corners = std::max(corners, mesh.face(f).size());
  return static_cast<std::int32_t>(corners);
}

std::string header_of(const MapMesh& painted, const std::string& real, const std::string& count) {
  std::string header =
      "ply\nformat binary_little_endian 1.0\n"
      "comment tx ty tz: image of the vertex on the target, nan where there is none; colours: normalised tx ty tz\n";
  header += "element vertex " + std::to_string(painted.mesh.vertex_count()) + '\n';
  for (const char* name : {"x", "y", "z"}) header += "property " + real + ' ' + name + '\n';
  for (const char* name : {"red", "green", "blue"}) header += std::string("property uchar ") + name + '\n';
  for (const char* name : {"tx", "ty", "tz"}) header += "property " + real + ' ' + name + '\n';
  header += "element face " + std::to_string(painted.mesh.face_count()) + '\n';
  return header + "property list " + count + " int vertex_indices\nend_header\n";
}

template <typename Real>
void append_vertices(std::string& bytes, const MapMesh& painted) {
  for (Eigen::Index v = 0; v < painted.mesh.vertices.rows(); ++v) {
    for (int k = 0; k < 3; ++k) append(bytes, static_cast<Real>(painted.mesh.vertices(v, k)));
    for (int k = 0; k < 3; ++k) append(bytes, painted.colors(v, k));
    for (int k = 0; k < 3; ++k) append(bytes, static_cast<Real>(painted.images(v, k)));
  }
}

template <typename Count>
void append_faces(std::string& bytes, const PolygonMesh& mesh) {
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    append(bytes, static_cast<Count>(face.size()));
    bytes.append(reinterpret_cast<const char*>(face.data()), face.size_bytes());
  }
}

}  // namespace

std::string encode_ply(const MapMesh& painted) {
  const bool single = fits_float(box_of(painted.mesh.vertices)) && fits_float(box_of(painted.images));
  const bool small = largest_polygon(painted.mesh) <= 255;
  std::string bytes = header_of(painted, single ? "float" : "double", small ? "uchar" : "int");
  const std::size_t reals = 6 * (single ? sizeof(float) : sizeof(double));
  bytes.reserve(bytes.size() + static_cast<std::size_t>(painted.mesh.vertex_count()) * (reals + 3) +
                static_cast<std::size_t>(painted.mesh.face_count()) * (small ? 1 : 4) + painted.mesh.indices.size() * 4);
  single ? append_vertices<float>(bytes, painted) : append_vertices<double>(bytes, painted);
  small ? append_faces<std::uint8_t>(bytes, painted.mesh) : append_faces<std::int32_t>(bytes, painted.mesh);
  return bytes;
}

}  // namespace spherematch
