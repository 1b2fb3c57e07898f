// Little-endian numbers to and from bytes, on any machine; the reader never passes its end.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "storage/error.h"

namespace spherematch {

template <typename T>
concept StoredNumber = std::same_as<T, std::uint8_t> || std::same_as<T, std::uint16_t> || std::same_as<T, std::uint32_t> ||
    std::same_as<T, std::uint64_t> || std::same_as<T, std::int32_t> || std::same_as<T, float> || std::same_as<T, double>;

namespace detail {

template <std::size_t Size>
using UnsignedOfSize =
    std::conditional_t<Size == 1, std::uint8_t,
                       std::conditional_t<Size == 2, std::uint16_t, std::conditional_t<Size == 4, std::uint32_t, std::uint64_t>>>;

}  // namespace detail

/// Bytes are shifted one by one; compilers make this a plain move on a little-endian machine.
template <StoredNumber T>
void store_little_endian(T value, std::byte* out) {
  const std::uint64_t bits = std::bit_cast<detail::UnsignedOfSize<sizeof(T)>>(value);
  for (std::size_t i = 0; i < sizeof(T); ++i) out[i] = static_cast<std::byte>(bits >> (8 * i));
}

template <StoredNumber T>
[[nodiscard]] T load_little_endian(const std::byte* in) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) bits |= std::uint64_t{std::to_integer<std::uint8_t>(in[i])} << (8 * i);
  return std::bit_cast<T>(static_cast<detail::UnsignedOfSize<sizeof(T)>>(bits));
}

/// Appends to a byte vector.
class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::byte>& out) : out_(out) {}

  template <StoredNumber T>
  void number(T value) {
    array(&value, 1);
  }

  template <StoredNumber T>
  void array(const T* values, std::size_t count) {
    const std::size_t start = out_.size();
    out_.resize(start + count * sizeof(T));
    std::byte* to = out_.data() + start;
    for (std::size_t i = 0; i < count; ++i) store_little_endian(values[i], to + i * sizeof(T));
  }

  void text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size()));
    const auto bytes = std::as_bytes(std::span(value));
    out_.insert(out_.end(), bytes.begin(), bytes.end());
  }

 private:
  std::vector<std::byte>& out_;
};

/// Reads from a view that must outlive it. Throws StorageError(corrupt_blob) instead of passing the end.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <StoredNumber T>
  [[nodiscard]] T number() {
    T value{};
    array(&value, 1);
    return value;
  }

  template <StoredNumber T>
  void array(T* values, std::size_t count) {
    const std::byte* from = take<T>(count).data();
    for (std::size_t i = 0; i < count; ++i) values[i] = load_little_endian<T>(from + i * sizeof(T));
  }

  [[nodiscard]] std::string text() {
    const auto bytes = take<std::uint8_t>(number<std::uint32_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  /// To be asked before an array of `count` numbers is allocated.
  template <StoredNumber T>
  void require(std::uint64_t count) const {
    if (count > bytes_.size() / sizeof(T)) throw StorageError(StorageErrorCode::corrupt_blob, "a stored array is cut short");
  }

  [[nodiscard]] bool at_end() const { return bytes_.empty(); }

  void finish() const {
    if (!at_end()) throw StorageError(StorageErrorCode::corrupt_blob, "a stored blob is longer than its contents");
  }

 private:
  template <StoredNumber T>
  std::span<const std::byte> take(std::size_t count) {
    require<T>(count);
    const auto taken = bytes_.first(count * sizeof(T));
    bytes_ = bytes_.subspan(taken.size());
    return taken;
  }

  std::span<const std::byte> bytes_;
};

}  // namespace spherematch
