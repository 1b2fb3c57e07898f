// Numbers into files, as bytes and as text. Internal to engine/io.
#pragma once

#include <array>
#include <bit>
#include <charconv>
#include <string>

namespace spherematch {

static_assert(std::endian::native == std::endian::little, "the binary formats are written little-endian");

template <typename Number>
void append_bytes(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// In the shortest form that reads back to the same number, whatever the locale.
template <typename Number>
void append_text(std::string& text, Number number) {
  std::array<char, 32> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  text.append(digits.data(), result.ptr);
}

}  // namespace spherematch
