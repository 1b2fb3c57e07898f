#include "engine/io/transfer.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "engine/data/error.h"

namespace spherematch {

namespace {

/// A floating-point number as its bytes stand in an array.
template <typename Real>
class Codec {
 public:
  explicit Codec(bool big_endian) : swapped_(big_endian != (std::endian::native == std::endian::big)) {}

  [[nodiscard]] double load(const char* from) const {
    Raw raw;
    std::memcpy(raw.data(), from, raw.size());
    if (swapped_) std::reverse(raw.begin(), raw.end());
    return static_cast<double>(Eigen::numext::bit_cast<Real>(raw));
  }
  void store(char* to, double value) const {
    auto raw = Eigen::numext::bit_cast<Raw>(static_cast<Real>(value));
    if (swapped_) std::reverse(raw.begin(), raw.end());
    std::memcpy(to, raw.data(), raw.size());
  }

 private:
  using Raw = std::array<char, sizeof(Real)>;
  bool swapped_;
};

/// Calls use(codec) with the codec of a floating-point array.
template <typename Use>
void with_codec(const Array& array, Use use) {
  switch (array.item_bytes) {
    case 2:
      return use(Codec<Eigen::half>(array.big_endian));
    case 4:
      return use(Codec<float>(array.big_endian));
    default:
      return use(Codec<double>(array.big_endian));
  }
}

const char* row_of(const Array& array, std::size_t row_bytes, std::int32_t row) {
  if (row < 0 || row >= array.rows()) throw std::invalid_argument("the map goes to row " + std::to_string(row) + ", which does not exist");
  return array.bytes.data() + static_cast<std::size_t>(row) * row_bytes;
}

void fill_with_nothing(const Array& array, char* row, std::size_t row_bytes) {
  std::fill_n(row, row_bytes, '\0');
  if (!is_floating(array)) return;
  with_codec(array, [&](const auto& codec) {
    for (std::size_t at = 0; at < row_bytes; at += array.item_bytes) codec.store(row + at, std::numeric_limits<double>::quiet_NaN());
  });
}

void interpolate(const Array& values, const Correspondence& map, Eigen::Index i, char* row, std::size_t row_bytes) {
  std::array<const char*, 3> corners{};
  std::array<double, 3> weights{};
  std::size_t used = 0;
  for (int k = 0; k < 3; ++k) {
    const char* corner = row_of(values, row_bytes, map.corners(i, k));
    if (map.bary(i, k) == 0) continue;
    corners.at(used) = corner;
    weights.at(used++) = static_cast<double>(map.bary(i, k));
  }
  with_codec(values, [&](const auto& codec) {
    for (std::size_t at = 0; at < row_bytes; at += values.item_bytes) {
      double sum = 0;
      for (std::size_t k = 0; k < used; ++k) sum += weights[k] * codec.load(corners[k] + at);
      codec.store(row + at, sum);
    }
  });
}

}  // namespace

void check_interpolation(const Array& values, Interpolation interpolation) {
  if (interpolation == Interpolation::linear && !is_floating(values)) {
    throw EngineError(ErrorCode::invalid_parameter,
                      "interp: linear needs floating-point numbers and the array has dtype " + values.dtype + "; nearest works");
  }
}

Array transfer(const Array& values, const Correspondence& map, Interpolation interpolation) {
  check_interpolation(values, interpolation);
  Array result{.dtype = values.dtype,
               .kind = values.kind,
               .item_bytes = values.item_bytes,
               .big_endian = values.big_endian,
               .shape = values.shape,
               .bytes = {}};
  const std::size_t row_bytes = values.row_bytes();
  result.shape.front() = static_cast<std::int64_t>(map.vertex.size());
  result.bytes.resize(map.vertex.size() * row_bytes);
  for (std::size_t i = 0; i < map.vertex.size(); ++i) {
    char* row = result.bytes.data() + i * row_bytes;
    if (map.vertex[i] < 0) {
      fill_with_nothing(values, row, row_bytes);
    } else if (interpolation == Interpolation::nearest) {
      std::memcpy(row, row_of(values, row_bytes, map.vertex[i]), row_bytes);
    } else {
      interpolate(values, map, static_cast<Eigen::Index>(i), row, row_bytes);
    }
  }
  return result;
}

}  // namespace spherematch
