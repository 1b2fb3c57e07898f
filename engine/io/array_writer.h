// Arrays out: NPY and NPZ. The bytes depend on the arguments alone: no dates, no compression.
// Source: NumPy, "NumPy Enhancement Proposal 1: a simple file format for NumPy arrays".
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/io/array.h"

namespace spherematch {

/// NPY version 1.0 in C order. `items` are those of the dtype and the shape.
[[nodiscard]] std::string encode_npy(std::string_view dtype, std::span<const std::int64_t> shape, std::span<const std::byte> items);
[[nodiscard]] std::string encode_npy(const Array& array);

/// One array of an archive.
struct NamedArray {
  std::string name;  ///< without ".npy"
  std::string npy;   ///< the bytes of its NPY file
};

/// A zip of the arrays in this order, stored uncompressed.
[[nodiscard]] std::string encode_npz(std::span<const NamedArray> arrays);

/// A matrix in row-major order as the items of encode_npy().
template <typename Matrix>
[[nodiscard]] std::span<const std::byte> items_of(const Matrix& matrix) {
  return std::as_bytes(std::span(matrix.data(), static_cast<std::size_t>(matrix.size())));
}

}  // namespace spherematch
