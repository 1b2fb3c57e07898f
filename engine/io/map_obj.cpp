#include <array>
#include <cstdio>

#include "engine/io/map_mesh.h"
#include "engine/io/number_output.h"

namespace spherematch {

namespace {

/// Each byte as a share of 255, in four decimals: enough to read the same byte back.
std::array<std::string, 256> color_words() {
  std::array<std::string, 256> words;
  for (std::size_t value = 0; value < words.size(); ++value) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), " %.4f", static_cast<double>(value) / 255);
    words[value] = text.data();
  }
  return words;
}

}  // namespace

std::string encode_obj(const MapMesh& painted) {
  const std::array<std::string, 256> words = color_words();
  std::string text = "# v x y z red green blue; colours: normalised coordinates of the vertex's image on the target\n";
  text.reserve(text.size() + static_cast<std::size_t>(painted.mesh.vertex_count()) * 80 + painted.mesh.indices.size() * 9);
  for (Eigen::Index v = 0; v < painted.mesh.vertices.rows(); ++v) {
    text += 'v';
    for (int k = 0; k < 3; ++k) append_text(text += ' ', painted.mesh.vertices(v, k));
    for (int k = 0; k < 3; ++k) text += words[painted.colors(v, k)];
    text += '\n';
  }
  for (std::int32_t f = 0; f < painted.mesh.face_count(); ++f) {
    text += 'f';
    for (const std::int32_t vertex : painted.mesh.face(f)) append_text(text += ' ', vertex + 1);
    text += '\n';
  }
  return text;
}

}  // namespace spherematch
