#include "server/match_response.h"

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

template <typename Map>
void select(Map& to, const Correspondence& from, const MatchFields& fields) {
  if (fields.vertex) to.vertex = from.vertex;
  if (fields.corners) to.corners = rows_of<std::int32_t>(from.corners);
  if (fields.bary) to.bary = rows_of<float>(from.bary);
}

template <typename Map>
void add_quality(Map& to, const Correspondence& from, const MatchFields& fields, const EnginePort& engine, const ShapePointer& source,
                 const ShapePointer& target) {
  VertexQuality quality = quality_of(from, fields, engine, source, target);
  if (fields.confidence) to.confidence = std::move(quality.confidence);
  if (fields.distortion) to.distortion = std::move(quality.distortion);
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
    } else if (name == "confidence") {
      fields.confidence = true;
    } else if (name == "distortion") {
      fields.distortion = true;
    } else {
      throw ProblemError(api::Code::invalid_parameter,
                         "fields: '" + std::string(name.substr(0, 64)) + "' is not one of vertex, corners, bary, confidence, distortion");
    }
  }
  return fields;
}

std::string canonical(const MatchFields& fields) {
  return std::string(fields.vertex ? "vertex," : "") + (fields.corners ? "corners," : "") + (fields.bary ? "bary" : "") +
         (fields.confidence ? ",confidence" : "") + (fields.distortion ? ",distortion" : "");
}

VertexQuality quality_of(const Correspondence& map, const MatchFields& fields, const EnginePort& engine, const ShapePointer& source,
                         const ShapePointer& target) {
  if (!fields.quality()) return {};
  VertexQuality quality = engine.vertex_quality(source, target, map);
  if (!fields.confidence) quality.confidence.clear();
  if (!fields.distortion) quality.distortion.clear();
  return quality;
}

api::Match match_of(const MatchQuery& query, const MatchAnswer& answer, const MatchFields& fields, std::int32_t n_tgt,
                    const EnginePort& engine, const MatchedShapes& shapes) {
  const MatchResult& result = *answer.result;
  api::Match match;
  match.src = query.src;
  match.tgt = query.tgt;
  match.n_src = static_cast<std::int32_t>(result.map.vertex.size());
  match.n_tgt = n_tgt;
  select(match, result.map, fields);
  add_quality(match, result.map, fields, engine, shapes.source, shapes.target);
  if (query.parameters.both) {
    match.reverse =
        api::ReverseMap{.n_src = n_tgt, .n_tgt = match.n_src, .vertex = {}, .corners = {}, .bary = {}, .confidence = {}, .distortion = {}};
    select(*match.reverse, result.reverse, fields);
    add_quality(*match.reverse, result.reverse, fields, engine, shapes.target, shapes.source);
  }
  match.orientation = result.reversed ? "reverse" : "preserve";
  match.candidate = query.parameters.candidate;
  match.quality = result.quality;
  for (const CandidateSummary& candidate : result.candidates) {
    match.candidates.push_back({candidate.rotation, candidate.correlation, candidate.score, candidate.chosen});
  }
  match.seconds = result.seconds;
  match.cached = answer.cached();
  match.engine = engine.version();
  return match;
}

}  // namespace spherematch
