// Mesh files in every format that the readers know, for the tests. Written apart from the writers of the engine.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/io/polygon_mesh.h"

namespace spherematch::test {

enum class PlyKind { ascii, little_endian, big_endian };

/// Numbers are written in their shortest form that reads back to the same double.
[[nodiscard]] std::string off_file(const PolygonMesh& mesh);
[[nodiscard]] std::string obj_file(const PolygonMesh& mesh);
/// Coordinates as double.
[[nodiscard]] std::string ply_file(const PolygonMesh& mesh, PlyKind kind);
/// Triangles only. Binary ones, as glTF below, hold coordinates as float.
[[nodiscard]] std::string ascii_stl_file(const PolygonMesh& mesh);
[[nodiscard]] std::string binary_stl_file(const PolygonMesh& mesh);
/// One node, one mesh, one primitive; triangles only.
[[nodiscard]] std::string gltf_file(const PolygonMesh& mesh);
[[nodiscard]] std::string glb_file(const PolygonMesh& mesh);

struct MeshFile {
  std::string name;  ///< with the extension
  std::string bytes;
};
/// The mesh, of triangles, by all functions above.
[[nodiscard]] std::vector<MeshFile> in_every_format(const PolygonMesh& mesh);

/// The mesh with coordinates that float holds, its vertices numbered as its triangles meet them first.
[[nodiscard]] PolygonMesh fit_for_every_format(const TriMesh& mesh);

// Pieces of binary files
template <typename Number>
void append_number(std::string& bytes, Number number, bool big_endian = false) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}
[[nodiscard]] std::string base64(std::string_view bytes);
/// A GLB file of the two chunks, filled up to multiples of four; the second one only when it is not empty.
[[nodiscard]] std::string glb_container(std::string json, std::string binary);
/// glTF JSON for one triangle mesh in buffer 0: `vertices` floats by three, then `indices` 32-bit indices. The buffer's `uri` is left
/// out when empty; `more` are further members of the top level, such as R"("scene": 0, )".
[[nodiscard]] std::string gltf_json(std::int64_t vertices, std::int64_t indices, const std::string& uri, const std::string& more = "");
/// The buffer that it speaks of.
[[nodiscard]] std::string gltf_buffer(const PolygonMesh& mesh);

}  // namespace spherematch::test
