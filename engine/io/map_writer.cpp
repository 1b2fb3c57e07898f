#include "engine/io/map_writer.h"

#include <array>
#include <charconv>
#include <span>
#include <vector>

#include "engine/io/array_writer.h"

namespace spherematch {

namespace {

/// A matrix as NPY, (n, columns).
template <typename Matrix>
std::string matrix_npy(std::string_view dtype, const Matrix& matrix) {
  return encode_npy(dtype, std::array<std::int64_t, 2>{matrix.rows(), matrix.cols()}, items_of(matrix));
}

void add_map(std::vector<NamedArray>& arrays, const std::string& prefix, const Correspondence& map) {
  arrays.push_back({prefix + "vertex", encode_npy(map)});
  arrays.push_back({prefix + "corners", matrix_npy("<i4", map.corners)});
  arrays.push_back({prefix + "bary", matrix_npy("<f4", map.bary)});
}

/// The indices, one a line, counted from `first`; a dropped vertex has the number before it.
std::string list(const Correspondence& map, std::int32_t first) {
  std::string text;
  text.reserve(map.vertex.size() * 7);
  std::array<char, 16> digits{};
  for (const std::int32_t vertex : map.vertex) {
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), vertex + first);
    text.append(digits.data(), result.ptr);
    text += '\n';
  }
  return text;
}

}  // namespace

std::string encode_npy(const Correspondence& map) {
  const std::array<std::int64_t, 1> shape{static_cast<std::int64_t>(map.vertex.size())};
  return encode_npy("<i4", shape, std::as_bytes(std::span(map.vertex)));
}

std::string encode_npy(const Points& points) { return matrix_npy("<f8", points); }

std::string encode_text(const Correspondence& map) { return list(map, 0); }

std::string encode_list_from_one(const Correspondence& map) { return list(map, 1); }

std::string encode_npz(const Correspondence& map) {
  std::vector<NamedArray> arrays;
  add_map(arrays, "", map);
  return encode_npz(arrays);
}

std::string encode_npz(const Correspondence& map, const Correspondence& reverse) {
  std::vector<NamedArray> arrays;
  add_map(arrays, "", map);
  add_map(arrays, "reverse_", reverse);
  return encode_npz(arrays);
}

}  // namespace spherematch
