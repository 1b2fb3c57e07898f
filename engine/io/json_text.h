// Text as a JSON string, for what writes JSON without a library.
#pragma once

#include <string>
#include <string_view>

namespace spherematch {

/// The text in quotes, with what JSON does not allow in them escaped. Bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string json_text(std::string_view text);

}  // namespace spherematch
