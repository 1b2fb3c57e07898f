// A shape is named by what it is made of: the uploaded bytes and the options that change how they are read.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace spherematch {

struct ContentId {
  std::string id;       ///< 32 lower-case hex digits, the shape's name in every interface
  std::string sha256;   ///< 64 lower-case hex digits: SHA-256 of the bytes alone
  std::string options;  ///< canonical options that went into the id, for example "repair=fill"
};

/// The id is the first half of SHA-256(bytes, a zero byte, options), so that it is the same on every machine and in every
/// release. `options` holds no zero byte. One pass over the bytes; thread-safe.
[[nodiscard]] ContentId content_id(std::span<const std::byte> bytes, std::string_view options);

/// Whether the text has the form of a shape id.
[[nodiscard]] bool is_shape_id(std::string_view text);

}  // namespace spherematch
