#include "server/request_parameters.h"

#include <algorithm>
#include <charconv>

#include "server/problem.h"

namespace spherematch {

namespace {

[[noreturn]] void refuse(const std::string& detail) { throw ProblemError(api::Code::invalid_parameter, detail); }

/// Long values are cut: the message goes back to whoever sent them.
std::string quoted(const std::string& value) { return "'" + (value.size() > 64 ? value.substr(0, 64) + "..." : value) + "'"; }

template <typename T>
std::optional<T> parse(const std::string& text) {
  T value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace

std::string joined(std::span<const std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) text.append(text.empty() ? "" : ", ").append(word);
  return text;
}

std::string percent_encoded(std::string_view text) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string encoded;
  for (const char c : text) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '_' || c == '~';
    const auto byte = static_cast<unsigned char>(c);
    if (plain) {
      encoded += c;
    } else {
      encoded.append("%").append(1, digits[byte >> 4]).append(1, digits[byte & 15]);
    }
  }
  return encoded;
}

RequestParameters::RequestParameters(const HttpRequest& request, std::initializer_list<std::string_view> allowed) : request_(request) {
  for (const auto& [name, value] : request.query) {
    if (std::find(allowed.begin(), allowed.end(), name) == allowed.end()) {
      const std::string known = joined({allowed.begin(), allowed.size()});
      refuse("unknown parameter " + quoted(name) + "; " + (known.empty() ? "none is allowed here" : "allowed are " + known));
    }
    if (request.query.count(name) > 1) refuse(name + ": given more than once");
  }
}

std::optional<std::string> RequestParameters::text(std::string_view name) const {
  const auto found = request_.query.find(std::string(name));
  if (found == request_.query.end()) return std::nullopt;
  return found->second;
}

std::string RequestParameters::required(std::string_view name) const {
  const auto value = text(name);
  if (!value || value->empty()) refuse(std::string(name) + ": is missing");
  return *value;
}

std::string RequestParameters::choice(std::string_view name, std::span<const std::string_view> choices) const {
  const auto value = text(name);
  if (!value) return std::string(choices.front());
  if (std::find(choices.begin(), choices.end(), *value) == choices.end()) {
    refuse(std::string(name) + ": " + quoted(*value) + " is not one of " + joined(choices));
  }
  return *value;
}

std::int64_t RequestParameters::integer(std::string_view name, std::int64_t fallback, std::int64_t least, std::int64_t most) const {
  const auto given = text(name);
  if (!given) return fallback;
  const auto value = parse<std::int64_t>(*given);
  if (!value || *value < least || *value > most) {
    refuse(std::string(name) + ": " + quoted(*given) + " is not an integer from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return *value;
}

std::chrono::milliseconds RequestParameters::seconds(std::string_view name, double fallback, double most) const {
  double value = fallback;
  if (const auto given = text(name)) {
    const auto parsed = parse<double>(*given);
    if (!parsed || !(*parsed >= 0 && *parsed <= most)) {
      refuse(std::string(name) + ": " + quoted(*given) + " is not a number of seconds from 0 to " + std::to_string(static_cast<int>(most)));
    }
    value = *parsed;
  }
  return std::chrono::milliseconds(static_cast<std::int64_t>(value * 1000));
}

}  // namespace spherematch
