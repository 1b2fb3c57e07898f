// Which representation of a result to send: the `format` parameter, or else the Accept header (RFC 9110, section 12.5.1).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace spherematch {

struct Representation {
  std::string_view format;      ///< value of the `format` parameter
  std::string_view media_type;  ///< of the response
};

/// The offer with the highest quality in `accept`; among equals the first. An empty header accepts everything.
/// Null when nothing fits.
[[nodiscard]] const Representation* negotiate(std::string_view accept, std::span<const Representation> offers);

/// The offer that `format` names where given, else the negotiated one.
/// @throws ProblemError(invalid_parameter) for an unknown format, ProblemError(not_acceptable) listing what exists
[[nodiscard]] const Representation& choose_representation(const std::optional<std::string>& format, std::string_view accept,
                                                          std::span<const Representation> offers);

}  // namespace spherematch
