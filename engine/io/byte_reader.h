// Numbers of a binary file with their byte offsets, for the readers of binary formats.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace spherematch {

/// Reads forward and never beyond the bytes. `offset` is where the bytes stand in the file, for messages. Not thread-safe; copies are
/// independent.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes, std::size_t offset = 0, std::endian order = std::endian::little)
      : bytes_(bytes), offset_(offset), swapped_(order != std::endian::native) {}

  /// The next number. `what` names it in messages, such as "a vertex index".
  /// @throws EngineError(malformed_mesh) with the byte offset when the file ends before
  template <typename Number>
  Number read(std::string_view what) {
    if (remaining() < sizeof(Number)) fail_at_end(what);
    std::array<char, sizeof(Number)> raw{};
    std::memcpy(raw.data(), bytes_.data() + position_, sizeof(Number));
    if (swapped_) std::reverse(raw.begin(), raw.end());
    position_ += sizeof(Number);
    return std::bit_cast<Number>(raw);
  }

  /// @throws EngineError(malformed_mesh) with the byte offset when fewer than `count` bytes are left
  void skip(std::size_t count, std::string_view what) {
    if (remaining() < count) fail_at_end(what);
    position_ += count;
  }

  [[nodiscard]] std::size_t remaining() const { return bytes_.size() - position_; }

  /// "byte N: ", N the offset of what comes next.
  [[nodiscard]] std::string place() const;

  /// @throws EngineError(malformed_mesh) always: place() and the message
  [[noreturn]] void fail(const std::string& message) const;

 private:
  [[noreturn]] void fail_at_end(std::string_view what) const;

  std::string_view bytes_;
  std::size_t offset_;
  std::size_t position_ = 0;
  bool swapped_;
};

}  // namespace spherematch
