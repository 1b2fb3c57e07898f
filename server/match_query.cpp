#include "server/match_query.h"

#include <array>
#include <cstdio>
#include <string>

#include "engine/data/error.h"
#include "server/problem.h"

namespace spherematch {

namespace {

constexpr std::array<std::string_view, 2> methods{"default", "paper"};
constexpr std::array<std::string_view, 2> refinements{"default", "none"};
constexpr std::array<std::string_view, 3> orientations{"preserve", "reverse", "any"};  // in the order of Orientation
constexpr std::array<std::string_view, 2> cache_modes{"yes", "no"};

[[noreturn]] void refuse(const std::string& detail) { throw ProblemError(api::Code::invalid_parameter, detail); }

std::size_t index_in(std::string_view name, std::string_view value, std::span<const std::string_view> choices) {
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i] == value) return i;
  }
  refuse(std::string(name) + ": '" + std::string(value.substr(0, 64)) + "' is not one of " + joined(choices));
}

std::vector<Hint> hints_of(const std::string& text) {
  try {
    return parse_hints(text);
  } catch (const EngineError& error) {
    refuse(error.what());
  }
}

/// What every query may have, whichever way round.
void read_choices(MatchParameters& into, const RequestParameters& from) {
  into.hints = hints_of(from.text("hints").value_or(""));
  into.candidate = static_cast<int>(from.integer("candidate", 0, 0, into.max_candidates - 1));
}

}  // namespace

MatchParameters match_parameters_of(std::string_view method, std::string_view refine, std::string_view orientation) {
  MatchParameters parameters = index_in("method", method, methods) == 1 ? MatchParameters::paper() : MatchParameters{};
  if (index_in("refine", refine, refinements) == 1) parameters.elastic_iterations = {};
  parameters.orientation = static_cast<Orientation>(index_in("orientation", orientation, orientations));
  return parameters;
}

MatchQuery match_query_of(const RequestParameters& parameters) {
  MatchQuery query;
  query.src = parameters.required("src");
  query.tgt = parameters.required("tgt");
  query.parameters = match_parameters_of(parameters.choice("method", methods), parameters.choice("refine", refinements),
                                         parameters.choice("orientation", orientations));
  read_choices(query.parameters, parameters);
  return query;
}

MatchQuery symmetry_query_of(const std::string& shape, const RequestParameters& parameters) {
  MatchQuery query{
      .src = shape,
      .tgt = shape,
      .parameters = match_parameters_of(parameters.choice("method", methods), parameters.choice("refine", refinements), "reverse")};
  read_choices(query.parameters, parameters);
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
