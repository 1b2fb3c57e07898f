#include "samples/file_formats.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

namespace spherematch::samples {
namespace {

void append_little_endian(std::string& bytes, std::uint32_t value, int size) {
  for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xff));
}

void append_word(std::string& bytes, std::size_t value) { append_little_endian(bytes, static_cast<std::uint32_t>(value), 4); }

void pad(std::string& bytes, char filler) { bytes.resize((bytes.size() + 3) / 4 * 4, filler); }

/// The number that the text of an OFF file would give, so that all formats hold the same mesh.
float stored(double coordinate) { return static_cast<float>(static_cast<double>(std::llround(coordinate * 100)) / 100); }

std::string triple(const Vec3& p) { return '[' + decimal(p.x) + ',' + decimal(p.y) + ',' + decimal(p.z) + ']'; }

}  // namespace

std::string decimal(double coordinate) {
  const long long hundredths = std::llround(coordinate * 100);
  const long long magnitude = std::llabs(hundredths);
  std::string text(hundredths < 0 ? "-" : "");
  text += std::to_string(magnitude / 100);
  if (magnitude % 100 == 0) return text;
  text += '.' + std::to_string(100 + magnitude % 100).substr(1);
  return text.erase(text.find_last_not_of('0') + 1);
}

std::string off_file(const Mesh& mesh) {
  std::string text = "OFF\n" + std::to_string(mesh.vertices.size()) + ' ' + std::to_string(mesh.triangles.size()) + " 0\n";
  for (const Vec3& p : mesh.vertices) text += decimal(p.x) + ' ' + decimal(p.y) + ' ' + decimal(p.z) + '\n';
  for (const Triangle& t : mesh.triangles)
    text += "3 " + std::to_string(t[0]) + ' ' + std::to_string(t[1]) + ' ' + std::to_string(t[2]) + '\n';
  return text;
}

std::string glb_file(const Mesh& mesh, const std::string& name) {
  if (mesh.vertices.size() > 65535) throw std::invalid_argument("too many vertices for 16-bit indices");
  std::string data;
  Vec3 low = mesh.vertices.front(), high = low;
  for (const Vec3& p : mesh.vertices) {
    for (const double c : {p.x, p.y, p.z}) append_word(data, std::bit_cast<std::uint32_t>(stored(c)));
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const std::size_t positions = data.size();
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) append_little_endian(data, static_cast<std::uint32_t>(v), 2);
  const std::size_t indices = data.size() - positions;
  pad(data, '\0');

  std::string json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"name":")" + name +
                     R"(","primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)" +
                     R"({"bufferView":0,"componentType":5126,"count":)" + std::to_string(mesh.vertices.size()) +
                     R"(,"type":"VEC3","min":)" + triple(low) + R"(,"max":)" + triple(high) +
                     R"(},{"bufferView":1,"componentType":5123,"count":)" + std::to_string(3 * mesh.triangles.size()) +
                     R"(,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" + std::to_string(positions) +
                     R"(,"target":34962},{"buffer":0,"byteOffset":)" + std::to_string(positions) + R"(,"byteLength":)" +
                     std::to_string(indices) + R"(,"target":34963}],"buffers":[{"byteLength":)" + std::to_string(data.size()) + "}]}";
  pad(json, ' ');

  std::string file = "glTF";
  append_word(file, 2);
  append_word(file, 12 + 8 + json.size() + 8 + data.size());
  append_word(file, json.size());
  file += "JSON" + json;
  append_word(file, data.size());
  file += std::string("BIN\0", 4) + data;
  return file;
}

std::string vts_file(const std::vector<int>& vertices) {
  std::string text;
  for (const int v : vertices) text += std::to_string(v + 1) + '\n';
  return text;
}

}  // namespace spherematch::samples
