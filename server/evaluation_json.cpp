#include "server/evaluation_json.h"

#include <optional>
#include <variant>

#include "server/problem.h"

namespace spherematch {

namespace {

[[noreturn]] void refuse_length(const std::string& detail, std::int64_t limit, std::int64_t actual) {
  api::Problem problem;
  problem.code = api::Code::length_mismatch;
  problem.detail = detail;
  problem.limit = limit;
  problem.actual = actual;
  throw ProblemError(problem);
}

/// Numbers from 0, whatever they counted from; -1 stays.
std::vector<std::int32_t> from_zero(const std::vector<std::int32_t>& vertices, std::int32_t base, const char* name, std::int32_t count) {
  std::vector<std::int32_t> result;
  result.reserve(vertices.size());
  for (const std::int32_t vertex : vertices) {
    result.push_back(vertex < 0 ? -1 : vertex - base);
    if (result.back() < count) continue;
    throw ProblemError(api::Code::invalid_parameter, std::string(name) + "[" + std::to_string(result.size() - 1) +
                                                         "]: " + std::to_string(vertex) + " is no vertex of a shape that has " +
                                                         std::to_string(count));
  }
  return result;
}

GroundTruth landmark_truth(const api::LandmarkTruth& lists, std::int32_t base, std::int32_t source_vertices, std::int32_t target_vertices) {
  const std::vector<std::int32_t> source = from_zero(lists.source, base, "truth.source", source_vertices);
  GroundTruth truth;
  truth.direct = paired(source, from_zero(lists.target, base, "truth.target", target_vertices));
  if (lists.mirrored) truth.mirrored = paired(source, from_zero(*lists.mirrored, base, "truth.mirrored", target_vertices));
  return truth;
}

std::optional<api::MapError> error_of(const std::optional<MapError>& error) {
  if (!error) return std::nullopt;
  return api::MapError{.mean = error->mean,
                       .median = error->median,
                       .p95 = error->p95,
                       .max = error->max,
                       .auc = error->auc,
                       .area_mean = error->area_mean,
                       .scored = error->scored,
                       .unscored = error->unscored,
                       .curve = error->curve};
}

api::Continuity continuity_of(const Continuity& continuity) {
  const auto& [edges, torn, edge_distortion, stretch_median, stretch_p95, stretch_max, dirichlet, turned] = continuity;
  return {edges, torn, edge_distortion, stretch_median, stretch_p95, stretch_max, dirichlet, turned};
}

}  // namespace

GroundTruth truth_of(const api::EvaluationRequest& request, std::int32_t source_vertices, std::int32_t target_vertices) {
  if (std::holds_alternative<api::IdentityTruth>(request.truth)) {
    if (source_vertices == target_vertices) return identity_truth(source_vertices, target_vertices);
    refuse_length("the identity is no truth: src has " + std::to_string(source_vertices) + " uploaded vertices, tgt " +
                      std::to_string(target_vertices),
                  source_vertices, target_vertices);
  }
  if (const auto* list = std::get_if<api::IndexTruth>(&request.truth)) {
    const auto length = static_cast<std::int64_t>(list->targets.size());
    if (length == source_vertices) return index_truth(from_zero(list->targets, request.base, "truth", target_vertices));
    refuse_length("truth has " + std::to_string(length) + " elements, src has " + std::to_string(source_vertices) + " uploaded vertices",
                  source_vertices, length);
  }
  if (const auto* lists = std::get_if<api::LandmarkTruth>(&request.truth)) {
    return landmark_truth(*lists, request.base, source_vertices, target_vertices);
  }
  return {};
}

api::Evaluation evaluation_of(const MatchQuery& query, const MatchAnswer& answer, const Evaluation& evaluation, const std::string& engine) {
  return {.src = query.src,
          .tgt = query.tgt,
          .geodesic = error_of(evaluation.geodesic),
          .mirrored = error_of(evaluation.mirrored),
          .flipped = evaluation.flipped,
          .biharmonic = error_of(evaluation.biharmonic),
          .symmetric_integral = evaluation.symmetric_integral,
          .continuity = continuity_of(evaluation.continuity),
          .coverage = {evaluation.coverage.area, evaluation.coverage.vertices},
          .bijectivity = error_of(evaluation.bijectivity),
          .bijectivity_biharmonic = error_of(evaluation.bijectivity_biharmonic),
          .thresholds = curve_thresholds(),
          .orientation = answer.result->reversed ? "reverse" : "preserve",
          .seconds = evaluation.seconds,
          .cached = answer.cached(),
          .engine = engine};
}

}  // namespace spherematch
