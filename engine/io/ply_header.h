// The header of a PLY file: which elements follow, and how their rows are laid out. Internal to engine/io.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace spherematch {

enum class PlyEncoding { ascii, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] std::size_t size_of(PlyType type);
[[nodiscard]] bool is_integer(PlyType type);

struct PlyProperty {
  std::string_view name;
  PlyType type;  ///< of the value, or of each item of the list
  bool is_list = false;
  PlyType length_type{};  ///< of the list's length
};

struct PlyElement {
  std::string_view name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The fewest bytes that a row can take.
  [[nodiscard]] std::size_t shortest_row(PlyEncoding encoding) const;
  [[nodiscard]] bool has_lists() const;
};

/// Names point into the text.
struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;  ///< in the order of their rows
  std::size_t length = 0;            ///< bytes up to the first row
  std::int64_t lines = 0;            ///< lines up to the first row
};

/// Comments are skipped. Whatever the counts are, the bytes behind the header are enough for them.
/// @throws EngineError(malformed_mesh) with the line
[[nodiscard]] PlyHeader read_ply_header(std::string_view text);

}  // namespace spherematch
