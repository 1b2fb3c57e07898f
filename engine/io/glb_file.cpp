// The GLB container: a header, a chunk of JSON and a chunk of numbers (glTF 2.0 specification, chapters 3 and 4).
#include "engine/io/glb_file.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <vector>

#include "engine/io/float_range.h"
#include "engine/io/json_text.h"
#include "engine/io/polygon_fans.h"

namespace spherematch {

namespace {

static_assert(std::endian::native == std::endian::little, "GLB is little-endian");

using Rgba = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 4, Eigen::RowMajor>;

std::string number(double value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

template <typename Row>
std::string list(const Row& row) {
  return '[' + number(static_cast<double>(row(0))) + ',' + number(static_cast<double>(row(1))) + ',' + number(static_cast<double>(row(2))) +
         ']';
}

void append_word(std::string& file, std::size_t word) {
  const auto value = static_cast<std::uint32_t>(word);
  file.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append_chunk(std::string& file, std::uint32_t type, std::string_view content, char padding) {
  const std::size_t padded = (content.size() + 3) / 4 * 4;
  append_word(file, padded);
  append_word(file, type);
  file.append(content).append(padded - content.size(), padding);
}

std::string container(std::string_view json, std::string_view numbers) {
  std::string file = "glTF";
  file.reserve(json.size() + numbers.size() + 40);
  append_word(file, 2);
  append_word(file, 0);  // the length, once known
  append_chunk(file, 0x4E4F534A, json, ' ');
  append_chunk(file, 0x004E4942, numbers, '\0');
  std::string length;
  append_word(length, file.size());
  return file.replace(8, 4, length);
}

template <typename Matrix>
std::span<const typename Matrix::Scalar> span_of(const Matrix& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

std::string bounds(const Floats& positions) {
  return R"("min":)" + list(positions.colwise().minCoeff().eval()) + R"(,"max":)" + list(positions.colwise().maxCoeff().eval());
}

void append_item(std::string& list, const std::string& item) { list.append(list.empty() ? "" : ",").append(item); }

}  // namespace

int GlbFile::add_view(std::string_view bytes, const std::string& target) {
  numbers_.append((4 - numbers_.size() % 4) % 4, '\0');
  append_item(views_, R"({"buffer":0,"byteOffset":)" + std::to_string(numbers_.size()) + R"(,"byteLength":)" +
                          std::to_string(bytes.size()) + target + '}');
  numbers_.append(bytes);
  return view_count_++;
}

template <typename Number>
int GlbFile::add_numbers(std::span<const Number> numbers, std::size_t count, Use use, const std::string& format) {
  const std::string_view bytes(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
  const int view = add_view(bytes, R"(,"target":)" + std::to_string(static_cast<int>(use)));
  append_item(accessors_, R"({"bufferView":)" + std::to_string(view) + R"(,"count":)" + std::to_string(count) + ',' + format + '}');
  return accessor_count_++;
}

void GlbFile::add(const PolygonMesh& mesh, const Colors* colors, const Node& node) {
  std::string attribute;
  if (colors != nullptr) {
    Rgba rgba = Rgba::Constant(colors->rows(), 4, 255);
    rgba.leftCols<3>() = *colors;
    const int color = add_numbers(span_of(rgba), static_cast<std::size_t>(rgba.rows()), Use::vertices,
                                  R"("componentType":5121,"normalized":true,"type":"VEC4")");
    attribute = R"("COLOR_0":)" + std::to_string(color);
  }
  add_mesh(mesh, node, attribute, 0);
}

void GlbFile::add(const PolygonMesh& mesh, const LinearColors& colors, const Node& node) {
  const int color = add_numbers(span_of(colors), static_cast<std::size_t>(colors.rows()), Use::vertices,
                                R"("componentType":5123,"normalized":true,"type":"VEC4")");
  add_mesh(mesh, node, R"("COLOR_0":)" + std::to_string(color), 0);
}

void GlbFile::add(const PolygonMesh& mesh, const TextureCoordinates& coordinates, const std::string& png, const Node& node) {
  const int place = add_numbers(span_of(coordinates), static_cast<std::size_t>(coordinates.rows()), Use::vertices,
                                R"("componentType":5126,"type":"VEC2")");
  append_item(images_, R"({"mimeType":"image/png","bufferView":)" + std::to_string(add_view(png, "")) + '}');
  materials_ += R"(,{"doubleSided":true,"pbrMetallicRoughness":{"baseColorTexture":{"index":)" + std::to_string(image_count_++) +
                R"(},"metallicFactor":0,"roughnessFactor":0.8}})";
  add_mesh(mesh, node, R"("TEXCOORD_0":)" + std::to_string(place), image_count_);
}

void GlbFile::add_mesh(const PolygonMesh& mesh, const Node& node, const std::string& attribute, int material) {
  // Where float does not do, the node takes the place and the size, and the positions are relative to them.
  const Box box = box_of(mesh.vertices);
  Points positions = mesh.vertices;
  std::string placement;
  Eigen::RowVector3d translation = node.offset;
  if (!fits_float(box)) {
    const double scale = box.radius() > 0 ? std::exp2(std::ilogb(box.radius())) : 1;
    positions = (positions.rowwise() - box.center()) / scale;
    translation += box.center();
    placement = R"(,"scale":)" + list(Eigen::RowVector3d::Constant(scale).eval());
  }
  if (!placement.empty() || !translation.isZero(0)) placement += R"(,"translation":)" + list(translation);
  const Floats floats = positions.cast<float>();
  const auto n = static_cast<std::size_t>(floats.rows());
  const int position = add_numbers(span_of(floats), n, Use::vertices, R"("componentType":5126,"type":"VEC3",)" + bounds(floats));
  const int normal = add_numbers(span_of(vertex_normals(mesh, positions)), n, Use::vertices, R"("componentType":5126,"type":"VEC3")");
  const std::vector<std::uint32_t> triangles = fan_triangles(mesh, positions);
  const int indices =
      add_numbers(std::span<const std::uint32_t>(triangles), triangles.size(), Use::triangles, R"("componentType":5125,"type":"SCALAR")");
  append_item(meshes_, R"({"primitives":[{"attributes":{"POSITION":)" + std::to_string(position) + R"(,"NORMAL":)" +
                           std::to_string(normal) + (attribute.empty() ? "" : ",") + attribute + R"(},"indices":)" +
                           std::to_string(indices) + R"(,"material":)" + std::to_string(material) + "}]}");

  std::string item = R"({"mesh":)" + std::to_string(mesh_count_++);
  if (!node.name.empty()) item += R"(,"name":)" + json_text(node.name);
  append_item(nodes_, item + placement + '}');
}

std::string GlbFile::json() const {
  std::string roots;
  for (int i = 0; i < mesh_count_; ++i) append_item(roots, std::to_string(i));
  std::string textures;
  for (int i = 0; i < image_count_; ++i) append_item(textures, R"({"source":)" + std::to_string(i) + '}');
  const std::string pictures = images_.empty() ? "" : R"("images":[)" + images_ + R"(],"textures":[)" + textures + "],";
  return R"({"asset":{"version":"2.0","generator":"spherematch"},"scene":0,"scenes":[{"nodes":[)" + roots + R"(]}],"nodes":[)" + nodes_ +
         R"(],"meshes":[)" + meshes_ +
         R"(],"materials":[{"doubleSided":true,"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.8}})" + materials_ + "]," +
         pictures + R"("accessors":[)" + accessors_ + R"(],"bufferViews":[)" + views_ + R"(],"buffers":[{"byteLength":)" +
         std::to_string(numbers_.size()) + "}]}";
}

std::string GlbFile::bytes() const { return container(json(), numbers_); }

}  // namespace spherematch
