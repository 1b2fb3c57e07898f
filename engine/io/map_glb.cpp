// The GLB container: a header, a chunk of JSON and a chunk of numbers (glTF 2.0 specification, chapters 3 and 4).
#include <Eigen/Geometry>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "engine/io/float_range.h"
#include "engine/io/map_mesh.h"

namespace spherematch {

namespace {

static_assert(std::endian::native == std::endian::little, "GLB is little-endian");

using Floats = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Rgba = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// Twice the vector area of a polygon, about its first corner.
Eigen::RowVector3d area_vector(const Points& vertices, std::span<const std::int32_t> face) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  const Eigen::RowVector3d origin = vertices.row(face[0]);
  for (std::size_t i = 1; i + 1 < face.size(); ++i) sum += (vertices.row(face[i]) - origin).cross(vertices.row(face[i + 1]) - origin);
  return sum;
}

/// The corner whose fan keeps its worst triangle most upright, so that a polygon with one reflex corner does not fold over. Large
/// polygons, where trying each corner would take too long, get the fan of their first.
std::size_t fan_apex(const Points& vertices, std::span<const std::int32_t> face) {
  constexpr std::size_t most_tried = 32;
  if (face.size() == 3 || face.size() > most_tried) return 0;
  const Eigen::RowVector3d normal = area_vector(vertices, face);
  const auto corner = [&](std::size_t i) { return vertices.row(face[i % face.size()]); };
  std::size_t best = 0;
  double best_worst = -std::numeric_limits<double>::infinity();
  for (std::size_t apex = 0; apex < face.size(); ++apex) {
    double worst = std::numeric_limits<double>::infinity();
    for (std::size_t i = apex + 1; i + 1 < apex + face.size(); ++i)
      worst = std::min(worst, (corner(i) - corner(apex)).cross(corner(i + 1) - corner(apex)).dot(normal));
    if (worst > best_worst) {
      best_worst = worst;
      best = apex;
    }
  }
  return best;
}

std::vector<std::uint32_t> triangulated(const PolygonMesh& mesh, const Points& positions) {
  std::vector<std::uint32_t> triangles;
  triangles.reserve(mesh.indices.size() * 3);
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const std::size_t apex = fan_apex(positions, face);
    for (std::size_t i = apex + 1; i + 1 < apex + face.size(); ++i) {
      for (const std::size_t corner : {apex, i, i + 1}) triangles.push_back(static_cast<std::uint32_t>(face[corner % face.size()]));
    }
  }
  return triangles;
}

/// Area-weighted vertex normals of unit length, as glTF demands also of a vertex that no face gives a direction.
Floats normals_of(const PolygonMesh& mesh, const Points& positions) {
  Points sums = Points::Zero(positions.rows(), 3);
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const Eigen::RowVector3d normal = area_vector(positions, face);
    for (const std::int32_t vertex : face) sums.row(vertex) += normal;
  }
  Floats normals(positions.rows(), 3);
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const double length = sums.row(v).stableNorm();
    const Eigen::RowVector3d normal = sums.row(v) / length;
    normals.row(v) = normal.allFinite() ? normal.cast<float>() : Eigen::RowVector3f(0, 0, 1);
  }
  return normals;
}

std::string number(double value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

template <typename Row>
std::string list(const Row& row) {
  return '[' + number(static_cast<double>(row(0))) + ',' + number(static_cast<double>(row(1))) + ',' + number(static_cast<double>(row(2))) +
         ']';
}

/// The numbers of the file and the JSON that describes them, grown together.
class Contents {
 public:
  enum class Use { vertices = 34962, triangles = 34963 };

  /// `format` is the accessor's componentType and type, and what else it has.
  template <typename Number>
  void add(std::span<const Number> numbers, std::size_t count, Use use, const std::string& format) {
    const std::string separator = views_.empty() ? "" : ",";
    views_ += separator + R"({"buffer":0,"byteOffset":)" + std::to_string(bytes_.size()) + R"(,"byteLength":)" +
              std::to_string(numbers.size_bytes()) + R"(,"target":)" + std::to_string(static_cast<int>(use)) + '}';
    accessors_ +=
        separator + R"({"bufferView":)" + std::to_string(view_count_++) + R"(,"count":)" + std::to_string(count) + ',' + format + '}';
    bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
  }

  [[nodiscard]] std::string json(const std::string& node) const {
    return R"({"asset":{"version":"2.0","generator":"spherematch"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" + node +
           R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"COLOR_0":2},"indices":3,"material":0}]}],)"
           R"("materials":[{"doubleSided":true,"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.8}}],)"
           R"("accessors":[)" +
           accessors_ + R"(],"bufferViews":[)" + views_ + R"(],"buffers":[{"byteLength":)" + std::to_string(bytes_.size()) + "}]}";
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::string views_;
  std::string accessors_;
  int view_count_ = 0;
};

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

std::string container(std::string_view json, std::string_view bytes) {
  std::string file = "glTF";
  file.reserve(json.size() + bytes.size() + 40);
  append_word(file, 2);
  append_word(file, 0);  // the length, once known
  append_chunk(file, 0x4E4F534A, json, ' ');
  append_chunk(file, 0x004E4942, bytes, '\0');
  std::string length;
  append_word(length, file.size());
  return file.replace(8, 4, length);
}

template <typename Matrix>
std::span<const typename Matrix::Scalar> span_of(const Matrix& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

}  // namespace

std::string encode_glb(const MapMesh& painted) {
  // Where float does not do, the node takes the place and the size, and the positions are relative to them.
  const Box box = box_of(painted.mesh.vertices);
  Points positions = painted.mesh.vertices;
  std::string node;
  if (!fits_float(box)) {
    const double scale = box.radius() > 0 ? std::exp2(std::ilogb(box.radius())) : 1;
    positions = (positions.rowwise() - box.center()) / scale;
    node = R"(,"translation":)" + list(box.center()) + R"(,"scale":)" + list(Eigen::RowVector3d::Constant(scale).eval());
  }
  const Floats floats = positions.cast<float>();
  Rgba colors = Rgba::Constant(painted.colors.rows(), 4, 255);
  colors.leftCols<3>() = painted.colors;
  const std::vector<std::uint32_t> triangles = triangulated(painted.mesh, positions);

  Contents contents;
  const auto n = static_cast<std::size_t>(floats.rows());
  contents.add(span_of(floats), n, Contents::Use::vertices,
               R"("componentType":5126,"type":"VEC3","min":)" + list(floats.colwise().minCoeff().eval()) + R"(,"max":)" +
                   list(floats.colwise().maxCoeff().eval()));
  contents.add(span_of(normals_of(painted.mesh, positions)), n, Contents::Use::vertices, R"("componentType":5126,"type":"VEC3")");
  contents.add(span_of(colors), n, Contents::Use::vertices, R"("componentType":5121,"normalized":true,"type":"VEC4")");
  contents.add(std::span<const std::uint32_t>(triangles), triangles.size(), Contents::Use::triangles,
               R"("componentType":5125,"type":"SCALAR")");
  return container(contents.json(node), contents.bytes());
}

}  // namespace spherematch
