#include "server/match_query.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <optional>
#include <string>

#include "server/problem.h"

namespace spherematch {

namespace {

constexpr std::array<std::string_view, 2> methods{"default", "paper"};
constexpr std::array<std::string_view, 3> orientations{"preserve", "reverse", "any"};  // in the order of Orientation
constexpr std::array<std::string_view, 2> cache_modes{"yes", "no"};

[[noreturn]] void refuse(const std::string& detail) { throw ProblemError(api::Code::invalid_parameter, detail); }

std::size_t index_in(std::string_view name, std::string_view value, std::span<const std::string_view> choices) {
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i] == value) return i;
  }
  refuse(std::string(name) + ": '" + std::string(value.substr(0, 64)) + "' is not one of " + joined(choices));
}

std::optional<std::int32_t> vertex_number(std::string_view text) {
  std::int32_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

/// "12:40,77:3"
std::vector<Hint> parse_hints(std::string_view text) {
  std::vector<Hint> hints;
  while (!text.empty()) {
    const std::string_view pair = text.substr(0, text.find(','));
    text.remove_prefix(std::min(text.size(), pair.size() + 1));
    const auto colon = pair.find(':');
    const auto source = vertex_number(pair.substr(0, colon));
    const auto target = colon == std::string_view::npos ? std::nullopt : vertex_number(pair.substr(colon + 1));
    if (!source || !target) refuse("hints: '" + std::string(pair.substr(0, 64)) + "' is not a pair SOURCE:TARGET of vertex numbers");
    hints.push_back({*source, *target});
  }
  if (hints.size() > MatchParameters::max_hints) refuse("hints: more than " + std::to_string(MatchParameters::max_hints) + " pairs");
  return hints;
}

}  // namespace

MatchParameters match_parameters_of(std::string_view method, std::string_view orientation) {
  MatchParameters parameters = index_in("method", method, methods) == 1 ? MatchParameters::paper() : MatchParameters{};
  parameters.orientation = static_cast<Orientation>(index_in("orientation", orientation, orientations));
  return parameters;
}

MatchQuery match_query_of(const RequestParameters& parameters) {
  MatchQuery query;
  query.src = parameters.required("src");
  query.tgt = parameters.required("tgt");
  query.parameters = match_parameters_of(parameters.choice("method", methods), parameters.choice("orientation", orientations));
  query.parameters.hints = parse_hints(parameters.text("hints").value_or(""));
  return query;
}

MatchService::Cache cache_of(const RequestParameters& parameters) {
  return parameters.choice("cache", cache_modes) == "no" ? MatchService::Cache::bypass : MatchService::Cache::use;
}

void await_shapes(ShapeService& shapes, const MatchQuery& query, std::chrono::milliseconds wait) {
  const auto deadline = ShapeService::Clock::now() + wait;
  shapes.require_ready(query.src, deadline);
  shapes.require_ready(query.tgt, deadline);
}

std::string server_timing(const MatchAnswer& answer) {
  std::string text = "cache;desc=" + std::string(to_string(answer.source));
  if (answer.source != MatchSource::computed) return text;
  for (const auto& [stage, value] : answer.result->seconds) {
    std::array<char, 32> milliseconds{};
    std::snprintf(milliseconds.data(), milliseconds.size(), ";dur=%.1f", value * 1000);
    text.append(", ").append(stage).append(milliseconds.data());
  }
  return text;
}

}  // namespace spherematch
