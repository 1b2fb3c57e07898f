#include "tests/support/mesh_files.h"

#include <charconv>
#include <map>

namespace spherematch::test {

namespace {

void append_text(std::string& text, auto number, char after) {
  std::array<char, 32> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  text.append(digits.data(), result.ptr);
  text += after;
}

void append_row(std::string& text, const PolygonMesh& mesh, std::int32_t v) {
  for (int k = 0; k < 3; ++k) append_text(text, mesh.vertices(v, k), k < 2 ? ' ' : '\n');
}

void fill_to_four(std::string& bytes, char filling) { bytes.append((4 - bytes.size() % 4) % 4, filling); }

}  // namespace

std::string off_file(const PolygonMesh& mesh) {
  std::string text = "OFF\n" + std::to_string(mesh.vertex_count()) + ' ' + std::to_string(mesh.face_count()) + " 0\n";
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) append_row(text, mesh, v);
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    text += std::to_string(mesh.face(f).size());
    for (const std::int32_t v : mesh.face(f)) text += ' ' + std::to_string(v);
    text += '\n';
  }
  return text;
}

std::string obj_file(const PolygonMesh& mesh) {
  std::string text = "# a mesh\no it\n";
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    text += "v ";
    append_row(text, mesh, v);
  }
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    text += 'f';
    for (const std::int32_t v : mesh.face(f)) text += ' ' + std::to_string(v + 1);
    text += '\n';
  }
  return text;
}

std::string ply_file(const PolygonMesh& mesh, PlyKind kind) {
  const bool big = kind == PlyKind::big_endian;
  std::string bytes = "ply\nformat ";
  bytes += kind == PlyKind::ascii ? "ascii" : big ? "binary_big_endian" : "binary_little_endian";
  bytes += " 1.0\nelement vertex " + std::to_string(mesh.vertex_count()) +
           "\nproperty double x\nproperty double y\nproperty double z\nelement face " + std::to_string(mesh.face_count()) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (kind == PlyKind::ascii) {
      append_row(bytes, mesh, v);
    } else {
      for (int k = 0; k < 3; ++k) append_number(bytes, mesh.vertices(v, k), big);
    }
  }
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    if (kind == PlyKind::ascii) {
      bytes += std::to_string(mesh.face(f).size());
      for (const std::int32_t v : mesh.face(f)) bytes += ' ' + std::to_string(v);
      bytes += '\n';
    } else {
      append_number(bytes, static_cast<std::uint8_t>(mesh.face(f).size()));
      for (const std::int32_t v : mesh.face(f)) append_number(bytes, v, big);
    }
  }
  return bytes;
}

std::string ascii_stl_file(const PolygonMesh& mesh) {
  std::string text = "solid it\n";
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const std::int32_t v : mesh.face(f)) {
      text += "      vertex ";
      append_row(text, mesh, v);
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid it\n";
}

std::string binary_stl_file(const PolygonMesh& mesh) {
  std::string bytes(80, ' ');
  append_number(bytes, static_cast<std::uint32_t>(mesh.face_count()));
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) append_number(bytes, 0.0F);
    for (const std::int32_t v : mesh.face(f))
      for (int k = 0; k < 3; ++k) append_number(bytes, static_cast<float>(mesh.vertices(v, k)));
    append_number(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string gltf_buffer(const PolygonMesh& mesh) {
  std::string bytes;
  for (Eigen::Index i = 0; i < mesh.vertices.size(); ++i) append_number(bytes, static_cast<float>(mesh.vertices.data()[i]));
  for (const std::int32_t index : mesh.indices) append_number(bytes, static_cast<std::uint32_t>(index));
  return bytes;
}

std::string gltf_json(std::int64_t vertices, std::int64_t indices, const std::string& uri, const std::string& more) {
  const std::string positions_length = std::to_string(12 * vertices);
  const std::string indices_length = std::to_string(4 * indices);
  std::string json = R"({"asset": {"version": "2.0"}, )" + more;
  json += R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], )";
  json += R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], )";
  json += R"("accessors": [{"bufferView": 0, "componentType": 5126, "count": )" + std::to_string(vertices) + R"(, "type": "VEC3"}, )";
  json += R"({"bufferView": 1, "componentType": 5125, "count": )" + std::to_string(indices) + R"(, "type": "SCALAR"}], )";
  json += R"("bufferViews": [{"buffer": 0, "byteLength": )" + positions_length + "}, ";
  json += R"({"buffer": 0, "byteOffset": )" + positions_length + R"(, "byteLength": )" + indices_length + "}], ";
  json += R"("buffers": [{"byteLength": )" + std::to_string(12 * vertices + 4 * indices);
  return json + (uri.empty() ? "" : R"(, "uri": ")" + uri + '"') + "}]}";
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : letters[group >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string glb_container(std::string json, std::string binary) {
  fill_to_four(json, ' ');
  fill_to_four(binary, '\0');
  std::string bytes = "glTF";
  append_number(bytes, std::uint32_t{2});
  append_number(bytes, static_cast<std::uint32_t>(20 + json.size() + (binary.empty() ? 0 : 8 + binary.size())));
  append_number(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  if (binary.empty()) return bytes;
  append_number(bytes, static_cast<std::uint32_t>(binary.size()));
  return bytes + std::string("BIN\0", 4) + binary;
}

std::string gltf_file(const PolygonMesh& mesh) {
  return gltf_json(mesh.vertex_count(), static_cast<std::int64_t>(mesh.indices.size()),
                   "data:application/octet-stream;base64," + base64(gltf_buffer(mesh)));
}

std::string glb_file(const PolygonMesh& mesh) {
  return glb_container(gltf_json(mesh.vertex_count(), static_cast<std::int64_t>(mesh.indices.size()), ""), gltf_buffer(mesh));
}

std::vector<MeshFile> in_every_format(const PolygonMesh& mesh) {
  return {{"a.off", off_file(mesh)},
          {"a.obj", obj_file(mesh)},
          {"ascii.ply", ply_file(mesh, PlyKind::ascii)},
          {"little.ply", ply_file(mesh, PlyKind::little_endian)},
          {"big.ply", ply_file(mesh, PlyKind::big_endian)},
          {"ascii.stl", ascii_stl_file(mesh)},
          {"binary.stl", binary_stl_file(mesh)},
          {"a.gltf", gltf_file(mesh)},
          {"a.glb", glb_file(mesh)}};
}

PolygonMesh fit_for_every_format(const TriMesh& mesh) {
  PolygonMesh result;
  std::map<std::int32_t, std::int32_t> numbers;
  std::vector<std::int32_t> order;
  for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) {
    const std::int32_t v = mesh.faces.data()[i];
    const auto [entry, is_new] = numbers.try_emplace(v, static_cast<std::int32_t>(order.size()));
    if (is_new) order.push_back(v);
    result.indices.push_back(entry->second);
    if (i % 3 == 2) result.offsets.push_back(static_cast<std::int32_t>(i + 1));
  }
  result.vertices.resize(static_cast<Eigen::Index>(order.size()), 3);
  for (std::size_t i = 0; i < order.size(); ++i)
    result.vertices.row(static_cast<Eigen::Index>(i)) = mesh.vertices.row(order[i]).cast<float>().cast<double>();
  return result;
}

}  // namespace spherematch::test
