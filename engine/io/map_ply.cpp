// Internal layout of the file: a text header, then one record for each vertex and each polygon.
#include <cstddef>
#include <string_view>
#include <vector>

#include "engine/io/float_range.h"
#include "engine/io/map_mesh.h"
#include "engine/io/number_output.h"
#include "engine/io/ply_faces.h"

namespace spherematch {

namespace {

struct Scalar {
  std::string_view name;
  const std::vector<float>& values;
};

/// What each vertex has besides, in the order of the file.
std::vector<Scalar> scalars_of(const MapMesh& painted) {
  std::vector<Scalar> scalars;
  if (!painted.quality.confidence.empty()) scalars.push_back({"confidence", painted.quality.confidence});
  if (!painted.quality.distortion.empty()) scalars.push_back({"distortion", painted.quality.distortion});
  return scalars;
}

std::string header_of(const MapMesh& painted, const std::string& real) {
  std::string header =
      "ply\nformat binary_little_endian 1.0\n"
      "comment tx ty tz: image of the vertex on the target, nan where there is none; colours: normalised tx ty tz\n";
  header += "element vertex " + std::to_string(painted.mesh.vertex_count()) + '\n';
  for (const char* name : {"x", "y", "z"}) header += "property " + real + ' ' + name + '\n';
  for (const char* name : {"red", "green", "blue"}) header += std::string("property uchar ") + name + '\n';
  for (const char* name : {"tx", "ty", "tz"}) header += "property " + real + ' ' + name + '\n';
  for (const Scalar& scalar : scalars_of(painted)) header.append("property float ").append(scalar.name).append(1, '\n');
  return header + ply_face_header(painted.mesh);
}

template <typename Real>
void append_vertices(std::string& bytes, const MapMesh& painted) {
  const std::vector<Scalar> scalars = scalars_of(painted);
  for (Eigen::Index v = 0; v < painted.mesh.vertices.rows(); ++v) {
    for (int k = 0; k < 3; ++k) append_bytes(bytes, static_cast<Real>(painted.mesh.vertices(v, k)));
    for (int k = 0; k < 3; ++k) append_bytes(bytes, painted.colors(v, k));
    for (int k = 0; k < 3; ++k) append_bytes(bytes, static_cast<Real>(painted.images(v, k)));
    for (const Scalar& scalar : scalars) append_bytes(bytes, scalar.values[static_cast<std::size_t>(v)]);
  }
}

}  // namespace

std::string encode_ply(const MapMesh& painted) {
  const bool single = fits_float(box_of(painted.mesh.vertices)) && fits_float(box_of(painted.images));
  std::string bytes = header_of(painted, single ? "float" : "double");
  const std::size_t row = 6 * (single ? sizeof(float) : sizeof(double)) + 3 + scalars_of(painted).size() * sizeof(float);
  bytes.reserve(bytes.size() + static_cast<std::size_t>(painted.mesh.vertex_count()) * row + ply_faces_size(painted.mesh));
  single ? append_vertices<float>(bytes, painted) : append_vertices<double>(bytes, painted);
  append_ply_faces(bytes, painted.mesh);
  return bytes;
}

}  // namespace spherematch
