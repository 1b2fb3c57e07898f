// POST /evaluations: how good a match is.
#include <array>
#include <string>
#include <utility>

#include "api/json.h"
#include "engine/io/curve_picture.h"
#include "server/evaluation_json.h"
#include "server/match_query.h"
#include "server/negotiation.h"
#include "server/problem.h"
#include "server/request_parameters.h"
#include "server/server_context.h"

namespace spherematch {

namespace {

constexpr std::array<Representation, 2> representations{{{"json", "application/json"}, {"svg", "image/svg+xml"}}};

api::EvaluationRequest parse(HttpRequest& request) {
  const RequestBody body = std::exchange(request.body, {});
  try {
    return api::from_text<api::EvaluationRequest>(body.bytes);
  } catch (const api::JsonError& error) {
    throw ProblemError(api::Code::invalid_parameter, error.what());
  }
}

int candidate_of(const api::EvaluationRequest& request, int count) {
  if (request.candidate < count) return request.candidate;
  throw ProblemError(api::Code::invalid_parameter, "candidate: must be in [0, " + std::to_string(count - 1) + "]");
}

MatchQuery query_of(const api::EvaluationRequest& request) {
  MatchQuery query{request.src, request.tgt, match_parameters_of(request.method, request.refine, request.orientation)};
  query.parameters.both = request.both;
  query.parameters.candidate = candidate_of(request, query.parameters.max_candidates);
  for (const auto& [source, target] : request.hints) query.parameters.hints.push_back({source, target});
  return query;
}

std::string title_of(const ServerContext& context, const MatchQuery& query) {
  const auto name = [&context](const std::string& id) {
    const std::string given = context.shapes.get(id).name;
    return given.empty() ? id : given;
  };
  return name(query.src) + " to " + name(query.tgt);
}

/// Behind the gate, as a match is.
Evaluation measure(const ServerContext& context, const MatchQuery& query, const MatchResult& match, const GroundTruth& truth,
                   bool biharmonic) {
  const Gate::Permit permit = context.matches.enter();
  const PreparedParts parts = biharmonic ? PreparedParts::all : PreparedParts::without_eigenbasis;
  const ShapePointer source = context.shapes.load(query.src, parts), target = context.shapes.load(query.tgt, parts);
  const Correspondence* reverse = query.parameters.both ? &match.reverse : nullptr;
  return context.engine.evaluate(*source, *target, match.map, reverse, truth, {.report = {}, .stop = context.stop});
}

HttpResponse post_evaluation(const ServerContext& context, HttpRequest& from) {
  const RequestParameters parameters(from, {"format", "wait", "cache"});
  const Representation& chosen = choose_representation(parameters.text("format"), from.header("accept"), representations);
  const auto wait = parameters.seconds("wait", 30, max_wait_seconds);
  const MatchService::Cache cache = cache_of(parameters);
  const api::EvaluationRequest request = parse(from);
  const MatchQuery query = query_of(request);
  // Unlike a match an evaluation is never kept, so without room there is nothing to answer.
  context.matches.require_room();
  const auto src = context.shapes.require_usable(query.src);
  const auto tgt = context.shapes.require_usable(query.tgt);
  const GroundTruth truth = truth_of(request, src.vertices, tgt.vertices);
  await_shapes(context.shapes, query, wait);
  const MatchAnswer answer = context.match_service.get(query, cache);
  const Evaluation evaluation = measure(context, query, *answer.result, truth, request.biharmonic);
  return {.status = 200,
          .content_type = std::string(chosen.media_type),
          .body = chosen.format == "svg"
                      ? encode_svg(evaluation, title_of(context, query))
                      : api::to_text(api::to_json(evaluation_of(query, answer, evaluation, context.engine.version()))) + "\n",
          .headers = {{"Server-Timing", server_timing(answer)}, {"Cache-Control", "no-store"}}};
}

}  // namespace

void add_evaluation_routes(Router& router, const ServerContext& context) {
  router.add(
      "POST", "/evaluations", [&context](HttpRequest& request) { return post_evaluation(context, request); }, Body::json);
}

}  // namespace spherematch
