#include "engine/io/gltf_json.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "engine/data/error.h"
#include "engine/io/text_scanner.h"

namespace spherematch {

namespace {

constexpr int deepest = 64;
/// Upper bounds of what a value takes in nlohmann's and in tinygltf's structures together, with the slack of growing vectors.
constexpr std::size_t bytes_per_object = 1536;
constexpr std::size_t bytes_per_value = 192;
constexpr std::size_t free_bytes = std::size_t{64} << 20;
constexpr std::size_t file_size_factor = 4;
constexpr std::string_view largest_integer = "2147483647";

constexpr std::array<std::string_view, 34> kept_keys{"POSITION",       "accessors",   "asset",         "attributes", "buffer",
                                                     "bufferView",     "bufferViews", "buffers",       "byteLength", "byteOffset",
                                                     "byteStride",     "children",    "componentType", "count",      "extensionsRequired",
                                                     "extensionsUsed", "indices",     "matrix",        "mesh",       "meshes",
                                                     "mode",           "nodes",       "normalized",    "primitives", "rotation",
                                                     "scale",          "scene",       "scenes",        "sparse",     "translation",
                                                     "type",           "uri",         "values",        "version"};
static_assert(std::is_sorted(kept_keys.begin(), kept_keys.end()), "searched by bisection");
constexpr std::array<std::string_view, 4> transform_keys{"matrix", "rotation", "scale", "translation"};

class JsonReducer {
 public:
  JsonReducer(std::span<char> json, std::size_t offset, std::size_t file_size)
      : json_(json), offset_(offset), budget_(free_bytes + file_size_factor * file_size) {}

  void run() {
    skip_space();
    if (next() != '{') fail("'{' should stand here");
    reduce_object({.key = "", .depth = 0, .kept = true});
    skip_space();
    while (position_ < json_.size() && json_[position_] == '\0') ++position_;  // some writers fill the chunk of a GLB file with these
    if (position_ < json_.size()) fail("something follows the JSON text");
    if (!has_asset_) throw EngineError(ErrorCode::unsupported_format, "the file is JSON, but not glTF 2: it has no 'asset'");
  }

 private:
  struct Place {
    std::string_view key;  ///< of the member that the value belongs to, also as an item of an array
    int depth;
    bool kept;
  };

  void reduce_value(const Place& place) {
    if (place.depth > deepest) fail("values are nested more than " + std::to_string(deepest) + " deep");
    skip_space();
    switch (next()) {
      case '{':
        return reduce_object(place);
      case '[':
        return reduce_array(place);
      case '"':
        charge(place, bytes_per_value);
        (void)read_string();
        return;
      default:
        return check_literal(place);
    }
  }

  void reduce_object(const Place& place) {
    charge(place, bytes_per_object);
    bool has_uri = false;
    for (bool more = enters('}'); more; more = goes_on('}')) {
      const std::size_t first = position_;
      if (next() != '"') fail("the name of a member should stand here");
      const std::string_view key = read_string();
      skip_space();
      if (next() != ':') fail("':' should stand here");
      ++position_;
      skip_space();
      if (key == "uri") has_uri = starts_filled_string();
      const bool kept = place.kept && std::binary_search(kept_keys.begin(), kept_keys.end(), key);
      if (place.depth == 0 && key == "asset") has_asset_ = true;
      reduce_value({key, place.depth + 1, kept});
      if (place.kept && !kept) overwrite(first);
    }
    const bool is_buffer = place.kept && place.depth == 2 && place.key == "buffers";
    if (is_buffer && !has_uri && ++buffers_without_uri_ > 1) fail("more than one buffer has no 'uri'");
  }

  void reduce_array(const Place& place) {
    charge(place, bytes_per_value);
    for (bool more = enters(']'); more; more = goes_on(']')) reduce_value({place.key, place.depth + 1, place.kept});
  }

  /// Past an opening bracket; false, and past the closing one, when that follows.
  bool enters(char closing) {
    ++position_;
    skip_space();
    if (next() != closing) return true;
    ++position_;
    return false;
  }

  /// Past the comma after an item, or false, and past the closing bracket.
  bool goes_on(char closing) {
    skip_space();
    const char c = next();
    if (c != ',' && c != closing) fail(std::string("',' or '") + closing + "' should stand here");
    ++position_;
    if (c == ',') skip_space();
    return c == ',';
  }

  /// For the parser, a `uri` that is no string, or empty, is none.
  bool starts_filled_string() const { return next() == '"' && position_ + 1 < json_.size() && json_[position_ + 1] != '"'; }

  /// A number, true, false or null.
  void check_literal(const Place& place) {
    charge(place, bytes_per_value);
    const std::size_t first = position_;
    while (position_ < json_.size() && std::string_view(",]} \t\r\n").find(json_[position_]) == std::string_view::npos) ++position_;
    const std::string_view literal(json_.data() + first, position_ - first);
    if (literal.empty()) fail("a value should stand here");
    if (!place.kept || literal == "true" || literal == "false" || literal == "null") return;
    if (std::find(transform_keys.begin(), transform_keys.end(), place.key) != transform_keys.end()) return;
    const bool digits = literal.find_first_not_of("0123456789") == std::string_view::npos;
    const bool fits = literal.size() < largest_integer.size() || (literal.size() == largest_integer.size() && literal <= largest_integer);
    if (digits && fits) return;
    position_ = first;
    fail(quoted(literal) + " is not an integer from 0 to " + std::string(largest_integer));
  }

  /// The characters between the quotes, as they stand. A key with an escape is none that geometry needs.
  std::string_view read_string() {
    const std::size_t first = ++position_;
    for (; next() != '"'; ++position_) {
      if (static_cast<unsigned char>(json_[position_]) < ' ') fail("a control character stands within a string");
      if (json_[position_] == '\\') ++position_;
    }
    return {json_.data() + first, position_++ - first};
  }

  void overwrite(std::size_t first) {
    constexpr std::string_view empty_member = "\"\":0";
    for (std::size_t i = first; i < position_; ++i)
      if (json_[i] != '\n') json_[i] = ' ';
    std::copy(empty_member.begin(), empty_member.end(), json_.begin() + static_cast<std::ptrdiff_t>(first));
  }

  void charge(const Place& place, std::size_t bytes) {
    if (!place.kept) return;
    if (bytes > budget_) fail("there are too many values for a file of this size");
    budget_ -= bytes;
  }

  void skip_space() {
    while (position_ < json_.size() && std::string_view(" \t\r\n").find(json_[position_]) != std::string_view::npos) ++position_;
  }

  char next() const {
    if (position_ >= json_.size()) fail("the JSON text ends too early");
    return json_[position_];
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw EngineError(ErrorCode::malformed_mesh, "byte " + std::to_string(offset_ + position_) + ": " + message);
  }

  std::span<char> json_;
  std::size_t offset_;
  std::size_t budget_;
  std::size_t position_ = 0;
  bool has_asset_ = false;
  int buffers_without_uri_ = 0;
};

}  // namespace

void reduce_gltf_json(std::span<char> json, std::size_t offset, std::size_t file_size) { JsonReducer(json, offset, file_size).run(); }

}  // namespace spherematch
