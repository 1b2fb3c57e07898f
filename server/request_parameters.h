// Query parameters, strictly: an unknown or repeated one is refused, and every message names the parameter.
#pragma once

#include <chrono>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "server/http_message.h"

namespace spherematch {

class RequestParameters {
 public:
  /// The request must outlive this. @throws ProblemError(invalid_parameter) naming the allowed ones
  RequestParameters(const HttpRequest& request, std::initializer_list<std::string_view> allowed);

  [[nodiscard]] std::optional<std::string> text(std::string_view name) const;

  // Each of these throws ProblemError(invalid_parameter) with the reason.

  [[nodiscard]] std::string required(std::string_view name) const;
  /// One of `choices`; the first where the parameter is missing.
  [[nodiscard]] std::string choice(std::string_view name, std::span<const std::string_view> choices) const;
  [[nodiscard]] std::int64_t integer(std::string_view name, std::int64_t fallback, std::int64_t least, std::int64_t most) const;
  /// Seconds in [0, most], decimals allowed.
  [[nodiscard]] std::chrono::milliseconds seconds(std::string_view name, double fallback, double most) const;

 private:
  const HttpRequest& request_;
};

/// Text as it may stand in a query (RFC 3986, section 2): everything but letters, digits, '-', '.', '_' and '~' as %XX.
[[nodiscard]] std::string percent_encoded(std::string_view text);

/// "a, b, c"
[[nodiscard]] std::string joined(std::span<const std::string_view> words);

}  // namespace spherematch
