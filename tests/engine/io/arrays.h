// Arrays for the tests of what is done with them.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <utility>
#include <vector>

#include "engine/io/array.h"

namespace spherematch::test {

/// Numbers of one type as an array of this shape.
template <typename Number>
Array array_of(const std::vector<Number>& numbers, const std::string& dtype, std::vector<std::int64_t> shape) {
  Array array{.dtype = dtype,
              .kind = dtype[1],
              .item_bytes = sizeof(Number),
              .big_endian = dtype[0] == '>',
              .shape = std::move(shape),
              .bytes = {}};
  for (const Number number : numbers) {
    auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    if (array.big_endian) std::reverse(raw.begin(), raw.end());
    array.bytes.append(raw.data(), raw.size());
  }
  return array;
}

}  // namespace spherematch::test
