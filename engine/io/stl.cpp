#include "engine/io/stl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/io/byte_reader.h"
#include "engine/io/distinct_points.h"
#include "engine/io/mesh_limits.h"
#include "engine/io/text_scanner.h"

namespace spherematch {

namespace {

constexpr std::size_t title_length = 80;
constexpr std::size_t header_length = 84;
/// Twelve floats and two bytes.
constexpr std::size_t triangle_length = 50;

std::uint64_t announced_triangles(std::string_view text) {
  return ByteReader(text.substr(title_length), title_length).read<std::uint32_t>("the number of triangles");
}

bool is_binary(std::string_view text) {
  return text.size() >= header_length && text.size() == header_length + triangle_length * announced_triangles(text);
}

bool equals_ignoring_case(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                    [](char w, char l) { return (w >= 'A' && w <= 'Z' ? static_cast<char>(w - 'A' + 'a') : w) == l; });
}

bool starts_solid(std::string_view text) { return equals_ignoring_case(TextScanner(text).word(), "solid"); }

/// Collects triangles corner by corner.
class Soup {
 public:
  explicit Soup(const MeshLimits& limits) : limits_(limits) {}

  template <typename Source>
  void add_corner(const std::array<double, 3>& point, const Source& source) {
    mesh_.indices.push_back(points_.number_of(point));
    limits_.check_vertices(points_.count());
    limits_.check_corners(static_cast<std::int64_t>(mesh_.indices.size()), source);
  }
  void end_triangle() { mesh_.offsets.push_back(static_cast<std::int32_t>(mesh_.indices.size())); }

  PolygonMesh mesh() && {
    check_not_empty(points_.count(), static_cast<std::int64_t>(mesh_.offsets.size()) - 1);
    mesh_.vertices = points_.points();
    return std::move(mesh_);
  }

 private:
  MeshLimits limits_;
  DistinctPoints points_;
  PolygonMesh mesh_;
};

PolygonMesh read_binary(std::string_view text, const MeshLimits& limits) {
  const std::uint64_t count = announced_triangles(text);
  ByteReader reader(text);
  reader.skip(header_length, "the header");
  Soup soup(limits);
  for (std::uint64_t f = 0; f < count; ++f) {
    reader.skip(3 * sizeof(float), "a normal");
    for (int corner = 0; corner < 3; ++corner) {
      std::array<double, 3> point{};
      for (double& coordinate : point) {
        coordinate = reader.read<float>("a coordinate");
        if (!std::isfinite(coordinate)) reader.fail("the coordinate before is not finite");
      }
      soup.add_corner(point, reader);
    }
    soup.end_triangle();
    reader.skip(sizeof(std::uint16_t), "an attribute");
  }
  return std::move(soup).mesh();
}

class AsciiReader {
 public:
  AsciiReader(std::string_view text, const MeshLimits& limits) : scanner_(text), soup_(limits) {}

  PolygonMesh read() {
    for (std::string_view word = scanner_.word(); !word.empty(); word = scanner_.word()) {
      require(word, "solid");
      scanner_.skip_line();
      read_solid();
    }
    return std::move(soup_).mesh();
  }

 private:
  void read_solid() {
    std::string_view word = scanner_.word();
    for (; equals_ignoring_case(word, "facet"); word = scanner_.word()) read_facet();
    require(word, "endsolid");
    scanner_.skip_line();
  }

  /// Some writers leave a normal out, or write one that is no number.
  void read_facet() {
    std::string_view word = scanner_.word();
    if (equals_ignoring_case(word, "normal"))
      for (int k = 0; k < 4 && !equals_ignoring_case(word, "outer"); ++k) word = scanner_.word();
    require(word, "outer");
    require(scanner_.word(), "loop");
    for (int corner = 0; corner < 3; ++corner) {
      require(scanner_.word(), "vertex");
      std::array<double, 3> point{};
      for (double& coordinate : point) coordinate = scanner_.real("a coordinate");
      soup_.add_corner(point, scanner_);
    }
    require(scanner_.word(), "endloop");
    require(scanner_.word(), "endfacet");
    soup_.end_triangle();
  }

  void require(std::string_view word, const std::string& keyword) const {
    if (word.empty()) scanner_.fail("the file ends where '" + keyword + "' should be");
    if (!equals_ignoring_case(word, keyword)) scanner_.fail(quoted(word) + " stands where '" + keyword + "' should be");
  }

  TextScanner scanner_;
  Soup soup_;
};

}  // namespace

bool is_stl(std::string_view text) { return is_binary(text) || starts_solid(without_byte_order_mark(text)); }

PolygonMesh read_stl(std::string_view text, const ReadLimits& limits) {
  const MeshLimits mesh_limits(limits);
  if (is_binary(text)) return read_binary(text, mesh_limits);
  // A damaged binary file has zero bytes early on, in its title or in its number of triangles; text has none.
  const bool is_text = text.substr(0, header_length).find('\0') == std::string_view::npos;
  if (is_text && starts_solid(without_byte_order_mark(text))) return AsciiReader(without_byte_order_mark(text), mesh_limits).read();
  if (text.size() < header_length) ByteReader(text, text.size()).fail("the file ends within the header of a binary STL file");
  const std::uint64_t count = announced_triangles(text);
  throw EngineError(ErrorCode::malformed_mesh, "byte " + std::to_string(title_length) + ": a binary STL file of " + std::to_string(count) +
                                                   " triangles has " + std::to_string(header_length + triangle_length * count) +
                                                   " bytes, this one has " + std::to_string(text.size()));
}

}  // namespace spherematch
