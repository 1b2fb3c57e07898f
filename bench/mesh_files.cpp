#include "bench/mesh_files.h"

#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>

#include "bench/mesh_growth.h"
#include "engine/engine.h"
#include "engine/io/mesh_writer.h"

namespace spherematch::bench {

namespace {

std::string bytes_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in || bytes.empty()) throw std::runtime_error(file + ": cannot be read");
  return bytes;
}

PolygonMesh polygons_of(const TriMesh& mesh) {
  PolygonMesh polygons;
  polygons.vertices = mesh.vertices;
  polygons.indices.assign(mesh.faces.data(), mesh.faces.data() + mesh.faces.size());
  for (Eigen::Index face = 1; face <= mesh.face_count(); ++face) polygons.offsets.push_back(static_cast<std::int32_t>(3 * face));
  return polygons;
}

}  // namespace

std::string resized_off(const std::string& file, std::int32_t vertices) {
  const std::string bytes = bytes_of(file);
  const Surface surface = read_surface(std::as_bytes(std::span(bytes)), file, {}, ReadLimits::none());
  return encode_mesh(MeshFormat::off, polygons_of(resized(surface.mesh, vertices)));
}

Surface read_resized(const std::string& file, std::int32_t vertices) {
  const std::string bytes = resized_off(file, vertices);
  return read_surface(std::as_bytes(std::span(bytes)), ".off", {}, ReadLimits::none());
}

}  // namespace spherematch::bench
