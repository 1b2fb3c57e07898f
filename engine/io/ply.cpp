#include "engine/io/ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "engine/io/byte_reader.h"
#include "engine/io/mesh_limits.h"
#include "engine/io/ply_header.h"
#include "engine/io/text_scanner.h"

namespace spherematch {

namespace {

/// Numbers of ASCII rows. Rows need not be lines.
class AsciiRows {
 public:
  AsciiRows(std::string_view text, const PlyHeader& header) : scanner_(text.substr(header.length), LineEnds::are_space, header.lines + 1) {}

  double real(PlyType /*type*/, std::string_view what) { return scanner_.real(what); }
  std::int64_t integer(PlyType /*type*/, std::string_view what) { return scanner_.integer(what); }
  void skip(PlyType /*type*/, std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i)
      if (scanner_.word().empty()) fail("the file ends where a value should be");
  }
  [[nodiscard]] std::string place() const { return scanner_.place(); }
  [[noreturn]] void fail(const std::string& message) const { scanner_.fail(message); }

 private:
  TextScanner scanner_;
};

/// Numbers of binary rows.
class BinaryRows {
 public:
  BinaryRows(std::string_view text, const PlyHeader& header)
      : reader_(text.substr(header.length), header.length,
                header.encoding == PlyEncoding::little_endian ? std::endian::little : std::endian::big) {}

  double real(PlyType type, std::string_view what) {
    const auto value = number<double>(type, what);
    if (!std::isfinite(value)) fail(std::string(what) + " is not finite");
    return value;
  }
  std::int64_t integer(PlyType type, std::string_view what) { return number<std::int64_t>(type, what); }
  void skip(PlyType type, std::int64_t count) {
    if (static_cast<std::size_t>(count) > reader_.remaining() / size_of(type)) fail("the file ends within a list");
    reader_.skip(static_cast<std::size_t>(count) * size_of(type), "a value");
  }
  [[nodiscard]] std::string place() const { return reader_.place(); }
  [[noreturn]] void fail(const std::string& message) const { reader_.fail(message); }

 private:
  template <typename Number>
  Number number(PlyType type, std::string_view what) {
    switch (type) {
      case PlyType::int8:
        return reader_.read<std::int8_t>(what);
      case PlyType::uint8:
        return reader_.read<std::uint8_t>(what);
      case PlyType::int16:
        return reader_.read<std::int16_t>(what);
      case PlyType::uint16:
        return reader_.read<std::uint16_t>(what);
      case PlyType::int32:
        return reader_.read<std::int32_t>(what);
      case PlyType::uint32:
        return reader_.read<std::uint32_t>(what);
      case PlyType::float32:
        return static_cast<Number>(reader_.read<float>(what));
      case PlyType::float64:
        break;
    }
    return static_cast<Number>(reader_.read<double>(what));
  }

  ByteReader reader_;
};

/// Where in a row the properties stand that a mesh needs.
struct Layout {
  const PlyElement* vertex = nullptr;
  const PlyElement* face = nullptr;
  std::array<const PlyProperty*, 3> coordinates{};
  const PlyProperty* corners = nullptr;
};

[[noreturn]] void fail_in_header(const std::string& message) { throw EngineError(ErrorCode::malformed_mesh, "PLY header: " + message); }

Layout layout_of(const PlyHeader& header) {
  Layout layout;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") layout.vertex = &element;
    if (element.name == "face") layout.face = &element;
  }
  if (layout.vertex == nullptr) fail_in_header("there is no element 'vertex'");
  if (layout.face == nullptr) fail_in_header("there is no element 'face'");
  for (const PlyProperty& property : layout.vertex->properties) {
    constexpr std::string_view names = "xyz";
    if (property.name.size() == 1 && !property.is_list && names.find(property.name) != std::string_view::npos)
      layout.coordinates[names.find(property.name)] = &property;
  }
  for (const PlyProperty* coordinate : layout.coordinates)
    if (coordinate == nullptr) fail_in_header("element 'vertex' needs the properties x, y and z");
  for (const PlyProperty& property : layout.face->properties)
    if (property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index")) layout.corners = &property;
  if (layout.corners == nullptr) fail_in_header("element 'face' needs the list vertex_indices");
  if (!is_integer(layout.corners->type)) fail_in_header("vertex_indices must be integers");
  return layout;
}

template <typename Rows>
void skip_property(Rows& rows, const PlyProperty& property) {
  if (!property.is_list) return rows.skip(property.type, 1);
  const std::int64_t length = rows.integer(property.length_type, "the length of a list");
  if (length < 0) rows.fail("the length of a list is negative");
  rows.skip(property.type, length);
}

template <typename Rows>
void skip_element(Rows& rows, const PlyElement& element) {
  if (element.properties.empty()) return;
  for (std::int64_t row = 0; row < element.count; ++row)
    for (const PlyProperty& property : element.properties) skip_property(rows, property);
}

template <typename Rows>
void read_vertices(Rows& rows, const Layout& layout, Points& vertices) {
  for (std::int64_t v = 0; v < layout.vertex->count; ++v)
    for (const PlyProperty& property : layout.vertex->properties) {
      const auto* const coordinate = std::find(layout.coordinates.begin(), layout.coordinates.end(), &property);
      if (coordinate == layout.coordinates.end()) {
        skip_property(rows, property);
      } else {
        vertices(v, coordinate - layout.coordinates.begin()) = rows.real(property.type, "a coordinate");
      }
    }
}

template <typename Rows>
void read_face(Rows& rows, const Layout& layout, const MeshLimits& limits, PolygonMesh& mesh) {
  const std::int64_t corners = rows.integer(layout.corners->length_type, "the number of corners of a face");
  limits.check_face(corners, static_cast<std::int64_t>(mesh.indices.size()), rows);
  for (std::int64_t k = 0; k < corners; ++k)
    mesh.indices.push_back(checked_index(rows.integer(layout.corners->type, "a vertex index"), layout.vertex->count, rows));
  mesh.offsets.push_back(static_cast<std::int32_t>(mesh.indices.size()));
}

template <typename Rows>
PolygonMesh read_rows(Rows rows, const PlyHeader& header, const Layout& layout, const MeshLimits& limits) {
  PolygonMesh mesh;
  mesh.vertices.resize(layout.vertex->count, 3);
  mesh.offsets.reserve(static_cast<std::size_t>(layout.face->count) + 1);
  mesh.indices.reserve(static_cast<std::size_t>(std::min(3 * layout.face->count, limits.corners())));
  const PlyElement* const last = std::max(layout.vertex, layout.face);
  for (const PlyElement& element : header.elements) {
    if (&element == layout.vertex) {
      read_vertices(rows, layout, mesh.vertices);
    } else if (&element == layout.face) {
      for (std::int64_t f = 0; f < element.count; ++f)
        for (const PlyProperty& property : element.properties)
          &property == layout.corners ? read_face(rows, layout, limits, mesh) : skip_property(rows, property);
    } else {
      skip_element(rows, element);
    }
    if (&element == last) break;
  }
  return mesh;
}

}  // namespace

bool is_ply(std::string_view text) { return text.starts_with("ply\n") || text.starts_with("ply\r\n"); }

PolygonMesh read_ply(std::string_view text, const ReadLimits& limits) {
  const PlyHeader header = read_ply_header(text);
  const Layout layout = layout_of(header);
  const MeshLimits mesh_limits(limits);
  mesh_limits.check_vertices(layout.vertex->count);
  check_not_empty(layout.vertex->count, layout.face->count);
  if (header.encoding == PlyEncoding::ascii) return read_rows(AsciiRows(text, header), header, layout, mesh_limits);
  return read_rows(BinaryRows(text, header), header, layout, mesh_limits);
}

}  // namespace spherematch
