// Text within HTML, SVG and XML.
#pragma once

#include <string>
#include <string_view>

namespace spherematch {

/// The text with what has a meaning in markup escaped, also within quotes. Control characters, of which XML allows three, become spaces.
[[nodiscard]] std::string escaped_markup(std::string_view text);

}  // namespace spherematch
