// Meshes with what is known at their vertices, as files.
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "engine/io/float_range.h"
#include "engine/io/glb_file.h"
#include "engine/io/number_output.h"
#include "engine/io/picture.h"
#include "engine/io/ply_faces.h"
#include "engine/io/renderer.h"
#include "engine/io/vertex_data.h"

namespace spherematch {

namespace {

void check_sizes(const PolygonMesh& mesh, const VertexData& data) {
  if (mesh.vertex_count() == data.paint.rows()) return;
  throw std::invalid_argument("the mesh has " + std::to_string(mesh.vertex_count()) + " vertices and its data " +
                              std::to_string(data.paint.rows()));
}

std::string property(const std::string& type, const std::string& name) { return "property " + type + ' ' + name + '\n'; }

/// The lines for what follows the coordinates and colours.
std::string data_properties(const VertexData& data) {
  std::string lines;
  switch (data.meaning) {
    case Meaning::color:
      break;
    case Meaning::texture:
      for (const char* name : {"s", "t", "texture_u", "texture_v"}) lines += property("float", name);
      break;
    case Meaning::label:
      lines = property("int", "label");
      break;
    case Meaning::value:
      lines = property("float", "quality");
      break;
    case Meaning::weights:
      for (Eigen::Index k = 0; k < data.numbers.cols(); ++k) lines += property("float", "weight_" + std::to_string(k));
      break;
  }
  return lines;
}

void append_data(std::string& bytes, const VertexData& data, Eigen::Index v) {
  switch (data.meaning) {
    case Meaning::color:
      break;
    case Meaning::texture:
      for (int twice = 0; twice < 2; ++twice)
        for (int k = 0; k < 2; ++k) append_bytes(bytes, static_cast<float>(data.paint(v, k)));
      break;
    case Meaning::label:
      append_bytes(bytes, static_cast<std::int32_t>(data.numbers(v, 0)));
      break;
    case Meaning::value:
    case Meaning::weights:
      for (Eigen::Index k = 0; k < data.numbers.cols(); ++k) append_bytes(bytes, static_cast<float>(data.numbers(v, k)));
      break;
  }
}

/// From the numbers of screens (IEC 61966-2-1) to those of light, in which glTF has vertex colours.
LinearColors linear_colors(const Colors& colors) {
  std::array<std::uint16_t, 256> light{};
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double share = static_cast<double>(i) / 255;
    light[i] = static_cast<std::uint16_t>(std::lround(65535 * (share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4))));
  }
  LinearColors linear = LinearColors::Constant(colors.rows(), 4, 65535);
  linear.leftCols<3>() = colors.unaryExpr([&](std::uint8_t number) { return light[number]; });
  return linear;
}

/// The checkerboard over the unit square, v upward.
std::string checkerboard() {
  constexpr int side = 256;
  Image image(side, side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const auto share = [](int i) { return (static_cast<float>(i) + 0.5F) / static_cast<float>(side); };
      const Eigen::Vector3f color = checker_color(share(x), 1 - share(y));
      for (int k = 0; k < 3; ++k) image.at(x, y)[k] = static_cast<std::uint8_t>(std::lround(255 * color(k)));
    }
  }
  return png_of(image);
}

}  // namespace

std::string encode_ply(const PolygonMesh& mesh, const VertexData& data) {
  check_sizes(mesh, data);
  const bool single = fits_float(box_of(mesh.vertices));
  const bool colored = data.meaning != Meaning::texture;
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertex_count()) + '\n';
  for (const char* name : {"x", "y", "z"}) bytes += property(single ? "float" : "double", name);
  if (colored)
    for (const char* name : {"red", "green", "blue"}) bytes += property("uchar", name);
  bytes += data_properties(data) + ply_face_header(mesh);
  const Colors colors = colored ? data.colors() : Colors();
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    for (int k = 0; k < 3; ++k) {
      single ? append_bytes(bytes, static_cast<float>(mesh.vertices(v, k))) : append_bytes(bytes, mesh.vertices(v, k));
    }
    if (colored)
      for (int k = 0; k < 3; ++k) append_bytes(bytes, colors(v, k));
    append_data(bytes, data, v);
  }
  append_ply_faces(bytes, mesh);
  return bytes;
}

std::string encode_glb(const PolygonMesh& mesh, const VertexData& data) {
  check_sizes(mesh, data);
  GlbFile file;
  if (data.meaning != Meaning::texture) {
    file.add(mesh, linear_colors(data.colors()), {});
    return file.bytes();
  }
  // glTF counts v downward.
  TextureCoordinates coordinates(data.paint.rows(), 2);
  coordinates.col(0) = data.paint.col(0).cast<float>();
  coordinates.col(1) = (1 - data.paint.col(1).array()).cast<float>();
  coordinates = coordinates.unaryExpr([](float number) { return std::isfinite(number) ? number : 0.0F; }).eval();
  file.add(mesh, coordinates, checkerboard(), {});
  return file.bytes();
}

}  // namespace spherematch
