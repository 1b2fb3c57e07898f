#include "engine/io/obj.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

#include "engine/io/mesh_limits.h"
#include "engine/io/text_scanner.h"

namespace spherematch {

namespace {

/// Statements that a file may have before its first vertex; those of free-form geometry come after it.
constexpr std::array<std::string_view, 16> keywords{"v", "vt", "vn",     "vp",     "f",      "fo",     "o",          "g",
                                                    "s", "mg", "mtllib", "usemtl", "usemap", "maplib", "shadow_obj", "trace_obj"};

bool starts_number(std::string_view word) {
  return !word.empty() && ((word[0] >= '0' && word[0] <= '9') || word[0] == '-' || word[0] == '+' || word[0] == '.');
}

class ObjReader {
 public:
  ObjReader(std::string_view text, const ReadLimits& limits)
      : scanner_(without_byte_order_mark(text), LineEnds::end_statements), limits_(limits) {}

  PolygonMesh read() {
    for (; scanner_.remaining() > 0; scanner_.skip_line()) {
      const std::string_view keyword = scanner_.word();
      if (keyword == "v") read_vertex();
      if (keyword == "f") read_face();
    }
    if (highest_index_ >= vertex_count()) at_highest_index_.fail(no_such_vertex(highest_index_ + 1));
    check_not_empty(vertex_count(), static_cast<std::int64_t>(mesh_.offsets.size()) - 1);
    mesh_.vertices = Eigen::Map<const Points>(coordinates_.data(), vertex_count(), 3);
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] std::int64_t vertex_count() const { return static_cast<std::int64_t>(coordinates_.size() / 3); }

  [[nodiscard]] std::string no_such_vertex(std::int64_t number) const {
    return "there is no vertex number " + std::to_string(number) + " among " + std::to_string(vertex_count());
  }

  void read_vertex() {
    for (int k = 0; k < 3; ++k) coordinates_.push_back(scanner_.real("a coordinate"));
    limits_.check_vertices(vertex_count());
  }

  void read_face() {
    const std::size_t before = mesh_.indices.size();
    for (std::string_view corner = scanner_.word(); !corner.empty(); corner = scanner_.word()) {
      mesh_.indices.push_back(index_of(corner));
      limits_.check_corners(static_cast<std::int64_t>(mesh_.indices.size()), scanner_);
    }
    limits_.check_face(static_cast<std::int64_t>(mesh_.indices.size() - before), static_cast<std::int64_t>(before), scanner_);
    mesh_.offsets.push_back(static_cast<std::int32_t>(mesh_.indices.size()));
  }

  /// The vertex of a corner, from 0. One that is still to come is checked at the end.
  std::int32_t index_of(std::string_view corner) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(corner.data(), corner.data() + corner.size(), number);
    const std::string_view rest = corner.substr(static_cast<std::size_t>(end - corner.data()));
    if (error != std::errc() || (!rest.empty() && rest[0] != '/') || rest.find_first_not_of("/-0123456789") != std::string_view::npos)
      scanner_.fail(quoted(corner) + " is not a corner of a face");
    if (number == 0) scanner_.fail("vertex numbers start at 1");
    const std::int64_t index = number > 0 ? number - 1 : vertex_count() + number;
    if (index < 0 || index >= limits_.vertices()) scanner_.fail(no_such_vertex(number));
    if (index > highest_index_) {
      highest_index_ = index;
      at_highest_index_ = scanner_;
    }
    return static_cast<std::int32_t>(index);
  }

  TextScanner scanner_;
  MeshLimits limits_;
  std::vector<double> coordinates_;
  PolygonMesh mesh_;
  std::int64_t highest_index_ = -1;
  TextScanner at_highest_index_ = scanner_;
};

}  // namespace

bool is_obj(std::string_view text) {
  TextScanner scanner(without_byte_order_mark(text), LineEnds::end_statements);
  for (; scanner.remaining() > 0; scanner.skip_line()) {
    const std::string_view keyword = scanner.word();
    if (keyword.empty()) continue;
    if (std::find(keywords.begin(), keywords.end(), keyword) == keywords.end()) return false;
    if (keyword == "v") return starts_number(scanner.word());
  }
  return false;
}

PolygonMesh read_obj(std::string_view text, const ReadLimits& limits) { return ObjReader(text, limits).read(); }

}  // namespace spherematch
