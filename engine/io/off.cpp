#include "engine/io/off.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "engine/data/error.h"
#include "engine/io/mesh_limits.h"
#include "engine/io/text_scanner.h"

namespace spherematch {

namespace {

/// The shortest a vertex ("0 0 0\n") and a face ("3 0 1 2\n") can be; the last line may lack its end.
constexpr std::int64_t shortest_vertex = 6;
constexpr std::int64_t shortest_face = 8;

/// The keyword that `word` starts with, or nothing. Counts may follow it without a space, as in files of ModelNet.
struct Keyword {
  std::size_t length = 0;
  bool homogeneous = false;    ///< 4OFF
  bool any_dimension = false;  ///< nOFF
};

Keyword keyword_of(std::string_view word) {
  Keyword keyword;
  const auto take = [&](std::string_view prefix) {
    if (!word.substr(keyword.length).starts_with(prefix)) return false;
    keyword.length += prefix.size();
    return true;
  };
  take("ST");
  take("C");
  take("N");
  keyword.homogeneous = take("4");
  keyword.any_dimension = take("n");
  if (!take("OFF")) return {};
  if (keyword.length < word.size() && (word[keyword.length] < '0' || word[keyword.length] > '9')) return {};
  return keyword;
}

void read_keyword(TextScanner& scanner) {
  const std::string_view word = scanner.word();
  const Keyword keyword = keyword_of(word);
  if (keyword.homogeneous || keyword.any_dimension)
    throw EngineError(ErrorCode::unsupported_format, "OFF files of other than three dimensions are not supported");
  // Without a keyword the first word is a count already.
  scanner.unread(word.size() - keyword.length);
  TextScanner ahead = scanner;
  if (keyword.length > 0 && ahead.word() == "BINARY")
    throw EngineError(ErrorCode::unsupported_format, "binary OFF files are not supported");
}

struct Counts {
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
};

Counts read_counts(TextScanner& scanner, const MeshLimits& limits) {
  Counts counts;
  counts.vertices = scanner.integer("the number of vertices");
  counts.faces = scanner.integer("the number of faces");
  if (counts.vertices < 0 || counts.faces < 0) scanner.fail("a count is negative");
  scanner.skip_line();
  const auto room = static_cast<std::int64_t>(scanner.remaining()) + 1;
  if (counts.vertices > room / shortest_vertex || counts.faces > (room - counts.vertices * shortest_vertex) / shortest_face)
    scanner.fail("the file is too short for " + std::to_string(counts.vertices) + " vertices and " + std::to_string(counts.faces) +
                 " faces");
  limits.check_vertices(counts.vertices);
  check_not_empty(counts.vertices, counts.faces);
  return counts;
}

void read_vertices(TextScanner& scanner, std::int64_t count, Points& vertices) {
  vertices.resize(count, 3);
  for (std::int64_t v = 0; v < count; ++v) {
    for (int k = 0; k < 3; ++k) vertices(v, k) = scanner.real("a coordinate");
    scanner.skip_line();
  }
}

void read_faces(TextScanner& scanner, const Counts& counts, const MeshLimits& limits, PolygonMesh& mesh) {
  mesh.offsets.reserve(static_cast<std::size_t>(counts.faces) + 1);
  mesh.indices.reserve(static_cast<std::size_t>(std::min(3 * counts.faces, limits.corners())));
  for (std::int64_t f = 0; f < counts.faces; ++f) {
    const std::int64_t corners = scanner.integer("the number of corners of a face");
    limits.check_face(corners, static_cast<std::int64_t>(mesh.indices.size()), scanner);
    for (std::int64_t k = 0; k < corners; ++k)
      mesh.indices.push_back(checked_index(scanner.integer("a vertex index"), counts.vertices, scanner));
    mesh.offsets.push_back(static_cast<std::int32_t>(mesh.indices.size()));
    scanner.skip_line();
  }
}

}  // namespace

bool is_off(std::string_view text) {
  TextScanner scanner(without_byte_order_mark(text));
  return keyword_of(scanner.word()).length > 0;
}

PolygonMesh read_off(std::string_view text, const ReadLimits& limits) {
  const MeshLimits mesh_limits(limits);
  TextScanner scanner(without_byte_order_mark(text));
  read_keyword(scanner);
  const Counts counts = read_counts(scanner, mesh_limits);
  PolygonMesh mesh;
  read_vertices(scanner, counts.vertices, mesh.vertices);
  read_faces(scanner, counts, mesh_limits, mesh);
  return mesh;
}

std::string write_off(const TriMesh& mesh) {
  std::string text = "OFF\n" + std::to_string(mesh.vertex_count()) + ' ' + std::to_string(mesh.face_count()) + " 0\n";
  std::array<char, 32> digits{};
  const auto append = [&](auto number, char after) {
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    text.append(digits.data(), result.ptr);
    text += after;
  };
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v)
    for (int k = 0; k < 3; ++k) append(mesh.vertices(v, k), k < 2 ? ' ' : '\n');
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    text += "3 ";
    for (int k = 0; k < 3; ++k) append(mesh.faces(f, k), k < 2 ? ' ' : '\n');
  }
  return text;
}

}  // namespace spherematch
