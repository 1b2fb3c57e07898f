// SPDX-License-Identifier: MIT
// Maps and arrays in the form in which they travel: NPY, and NPZ without compression.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spherematch::client {

/// Row i is uploaded source vertex i. Its image is the point of the target with the weights bary[i] in the vertices corners[i].
struct Map {
  std::vector<std::int32_t> vertex;                  ///< the corner nearest to the image; -1 for a dropped vertex
  std::vector<std::array<std::int32_t, 3>> corners;  ///< -1 for a dropped vertex
  std::vector<std::array<float, 3>> bary;            ///< non-negative, sum 1; 0 for a dropped vertex
  std::vector<float> confidence;                     ///< 0 to 1; empty where it was not asked for
  std::vector<float> distortion;                     ///< 0 for an isometry; empty where it was not asked for
  std::shared_ptr<const Map> reverse;                ///< from target to source, where it was asked for
};

/// The arrays of GET /match?format=npz. Numbers are little-endian, as on every machine that this library supports.
/// @throws FormatError
[[nodiscard]] Map decode_map(std::string_view npz);

/// Rows of `columns` numbers as NPY: (n,) for one column, else (n, columns). @throws std::invalid_argument for no whole rows
[[nodiscard]] std::string encode_npy(std::span<const double> values, std::size_t columns);

/// The numbers of an NPY file of float64 in C order. @throws FormatError
[[nodiscard]] std::vector<double> decode_npy(std::string_view npy);

}  // namespace spherematch::client
