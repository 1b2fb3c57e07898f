#include "server/match_response.h"

#include <cstdio>

#include "server/problem.h"

namespace spherematch {

namespace {

template <typename Scalar, typename Matrix>
std::vector<std::array<Scalar, 3>> rows_of(const Matrix& matrix) {
  std::vector<std::array<Scalar, 3>> rows;
  rows.reserve(static_cast<std::size_t>(matrix.rows()));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) rows.push_back({matrix(i, 0), matrix(i, 1), matrix(i, 2)});
  return rows;
}

}  // namespace

MatchFields parse_fields(std::string_view text) {
  MatchFields fields{.vertex = false};
  while (!text.empty()) {
    const auto comma = text.find(',');
    const std::string_view name = text.substr(0, comma);
    text = comma == std::string_view::npos ? std::string_view() : text.substr(comma + 1);
    if (name == "vertex") {
      fields.vertex = true;
    } else if (name == "corners") {
      fields.corners = true;
    } else if (name == "bary") {
      fields.bary = true;
    } else {
      throw ProblemError(api::Code::invalid_parameter,
                         "fields: '" + std::string(name.substr(0, 64)) + "' is not one of vertex, corners, bary");
    }
  }
  return fields;
}

std::string canonical(const MatchFields& fields) {
  return std::string(fields.vertex ? "vertex," : "") + (fields.corners ? "corners," : "") + (fields.bary ? "bary" : "");
}

api::Match match_of(const MatchResult& result, const MatchFields& fields) {
  api::Match match;
  match.n_src = static_cast<std::int32_t>(result.map.vertex.size());
  if (fields.vertex) match.vertex = result.map.vertex;
  if (fields.corners) match.corners = rows_of<std::int32_t>(result.map.corners);
  if (fields.bary) match.bary = rows_of<float>(result.map.bary);
  match.quality = result.quality;
  for (const CandidateSummary& candidate : result.candidates) {
    match.candidates.push_back({candidate.rotation, candidate.correlation, candidate.score, candidate.chosen});
  }
  match.seconds = result.seconds;
  return match;
}

std::string server_timing(const StageSeconds& seconds) {
  std::string text;
  for (const auto& [stage, value] : seconds) {
    std::array<char, 32> milliseconds{};
    std::snprintf(milliseconds.data(), milliseconds.size(), ";dur=%.1f", value * 1000);
    text.append(text.empty() ? "" : ", ").append(stage).append(milliseconds.data());
  }
  return text;
}

}  // namespace spherematch
