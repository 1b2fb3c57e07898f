// An array of numbers or of fixed-size records, as NPY files hold it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace spherematch {

/// Rows are what the first dimension counts.
struct Array {
  std::string dtype;                ///< as NumPy writes it: "<f4", ">i2", "|S5"
  char kind = 'f';                  ///< the letter of the dtype
  std::size_t item_bytes = 0;       ///< at least 1
  bool big_endian = false;          ///< of items of more than one byte
  std::vector<std::int64_t> shape;  ///< at least one dimension, none negative
  std::string bytes;                ///< the items in C order

  [[nodiscard]] std::int64_t rows() const { return shape.front(); }
  /// Of one row; also known where there are no rows.
  [[nodiscard]] std::size_t row_bytes() const {
    std::size_t size = item_bytes;
    for (std::size_t k = 1; k < shape.size(); ++k) size *= static_cast<std::size_t>(shape[k]);
    return size;
  }
};

}  // namespace spherematch
