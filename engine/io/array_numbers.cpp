#include "engine/io/array_numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "engine/data/error.h"

namespace spherematch {

namespace {

template <typename Number>
double load(const char* from, bool swapped) {
  std::array<char, sizeof(Number)> raw{};
  std::memcpy(raw.data(), from, raw.size());
  if (swapped) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(Eigen::numext::bit_cast<Number>(raw));
}

using Load = double (*)(const char*, bool);

/// Null for other dtypes.
Load loader_of(const Array& array) {
  struct Known {
    char kind;
    std::size_t bytes;
    Load load;
  };
  constexpr auto known = std::to_array<Known>({{'b', 1, load<std::uint8_t>},
                                               {'u', 1, load<std::uint8_t>},
                                               {'u', 2, load<std::uint16_t>},
                                               {'u', 4, load<std::uint32_t>},
                                               {'u', 8, load<std::uint64_t>},
                                               {'i', 1, load<std::int8_t>},
                                               {'i', 2, load<std::int16_t>},
                                               {'i', 4, load<std::int32_t>},
                                               {'i', 8, load<std::int64_t>},
                                               {'f', 2, load<Eigen::half>},
                                               {'f', 4, load<float>},
                                               {'f', 8, load<double>}});
  for (const Known& candidate : known) {
    if (candidate.kind == array.kind && candidate.bytes == array.item_bytes) return candidate.load;
  }
  return nullptr;
}

}  // namespace

Eigen::MatrixXd numbers_of(const Array& array) {
  const Load load = loader_of(array);
  if (load == nullptr) throw EngineError(ErrorCode::invalid_parameter, "the array has dtype " + array.dtype + ", which is no number");
  const bool swapped = array.big_endian != (std::endian::native == std::endian::big);
  const auto columns = static_cast<Eigen::Index>(array.row_bytes() / array.item_bytes);
  Eigen::MatrixXd numbers(array.rows(), columns);
  const char* item = array.bytes.data();
  for (Eigen::Index row = 0; row < numbers.rows(); ++row) {
    for (Eigen::Index column = 0; column < columns; ++column, item += array.item_bytes) numbers(row, column) = load(item, swapped);
  }
  return numbers;
}

}  // namespace spherematch
