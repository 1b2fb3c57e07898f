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

/// A list as NPY, (n,).
template <typename Number>
std::string list_npy(std::string_view dtype, const std::vector<Number>& numbers) {
  const std::array<std::int64_t, 1> shape{static_cast<std::int64_t>(numbers.size())};
  return encode_npy(dtype, shape, std::as_bytes(std::span(numbers)));
}

void add_map(std::vector<NamedArray>& arrays, const std::string& prefix, const Correspondence& map, const VertexQuality& quality) {
  arrays.push_back({prefix + "vertex", encode_npy(map)});
  arrays.push_back({prefix + "corners", matrix_npy("<i4", map.corners)});
  arrays.push_back({prefix + "bary", matrix_npy("<f4", map.bary)});
  if (!quality.confidence.empty()) arrays.push_back({prefix + "confidence", list_npy("<f4", quality.confidence)});
  if (!quality.distortion.empty()) arrays.push_back({prefix + "distortion", list_npy("<f4", quality.distortion)});
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

std::string encode_npy(const Correspondence& map) { return list_npy("<i4", map.vertex); }

std::string encode_npy(const Points& points) { return matrix_npy("<f8", points); }

std::string encode_text(const Correspondence& map) { return list(map, 0); }

std::string encode_list_from_one(const Correspondence& map) { return list(map, 1); }

std::string encode_npz(const Correspondence& map, const VertexQuality& quality) {
  std::vector<NamedArray> arrays;
  add_map(arrays, "", map, quality);
  return encode_npz(arrays);
}

std::string encode_npz(const Correspondence& map, const Correspondence& reverse, const VertexQuality& quality,
                       const VertexQuality& reverse_quality) {
  std::vector<NamedArray> arrays;
  add_map(arrays, "", map, quality);
  add_map(arrays, "reverse_", reverse, reverse_quality);
  return encode_npz(arrays);
}

}  // namespace spherematch
