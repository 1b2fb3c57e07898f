// POST /match: chosen points of one pair, or many pairs as a job.
#include <optional>

#include "api/json.h"
#include "engine/engine.h"
#include "server/job_json.h"
#include "server/match_query.h"
#include "server/problem.h"
#include "server/request_parameters.h"
#include "server/server_context.h"

namespace spherematch {

namespace {

api::MatchRequest parse(const HttpRequest& request) {
  try {
    return api::from_text<api::MatchRequest>(request.body.bytes);
  } catch (const api::JsonError& error) {
    throw ProblemError(api::Code::invalid_parameter, error.what());
  }
}

std::optional<PointImage> image_of(PointImages& images, const api::SurfacePoint& point) {
  if (const auto* vertex = std::get_if<std::int32_t>(&point)) return images.of_vertex(*vertex);
  if (const auto* corners = std::get_if<api::CornersPoint>(&point)) return images.of_corners(corners->corners, corners->bary);
  const auto& position = std::get<api::PositionPoint>(point).position;
  return images.of_position({position[0], position[1], position[2]});
}

/// `name` is where the point stands in the request.
std::optional<api::PointImage> answer_to(PointImages& images, const api::SurfacePoint& point, const std::string& name) {
  try {
    const auto image = image_of(images, point);
    if (!image) return std::nullopt;
    return api::PointImage{image->vertex, image->corners, image->bary, {image->position.x(), image->position.y(), image->position.z()}};
  } catch (const EngineError& error) {
    throw ProblemError(api::Code::invalid_parameter, name + ": " + error.what());
  }
}

HttpResponse match_points(const ServerContext& context, const api::MatchRequest& request, std::chrono::milliseconds wait) {
  MatchQuery query{request.src, request.tgt, match_parameters_of(request.method, request.refine, request.orientation)};
  for (const auto& [source, target] : request.hints) query.parameters.hints.push_back({source, target});
  await_shapes(context.shapes, query, wait);
  const ShapePointer source = context.shapes.load(query.src);
  const ShapePointer target = context.shapes.load(query.tgt);
  const MatchAnswer answer = context.match_service.get(query);

  PointImages images(answer.result->map, source->surface, target->surface);
  api::PointMatch match;
  match.src = query.src;
  match.tgt = query.tgt;
  if (request.points) {
    match.points.emplace();
    for (const api::SurfacePoint& point : *request.points) {
      match.points->push_back(answer_to(images, point, "points[" + std::to_string(match.points->size()) + "]"));
    }
  }
  if (request.landmarks) {
    match.landmarks.emplace();
    for (const auto& [name, point] : *request.landmarks) {
      match.landmarks->emplace_back(name, answer_to(images, point, "landmarks." + name));
    }
  }
  match.orientation = answer.result->reversed ? "reverse" : "preserve";
  match.quality = answer.result->quality;
  match.seconds = answer.result->seconds;
  match.cached = answer.cached();
  match.engine = context.engine.version();
  return {.status = 200,
          .content_type = "application/json",
          .body = api::to_text(api::to_json(match)) + "\n",
          .headers = {{"Server-Timing", server_timing(answer)}, {"Cache-Control", "private, no-cache"}}};
}

HttpResponse start_job(const ServerContext& context, const api::MatchRequest& request) {
  const std::string id = context.match_jobs.create(request);
  const auto record = context.jobs.find(id);
  if (!record) throw ProblemError(api::Code::not_found, "the job was removed");
  return {.status = 202,
          .content_type = "application/json",
          .body = api::to_text(api::to_json(job_of(*record, context.match_jobs.position(id)))) + "\n",
          .headers = {{"Location", "/jobs/" + id}}};
}

HttpResponse post_match(const ServerContext& context, const HttpRequest& from) {
  const RequestParameters parameters(from, {"wait"});
  const auto wait = parameters.seconds("wait", 30, max_wait_seconds);
  const api::MatchRequest request = parse(from);
  return request.pairs.empty() ? match_points(context, request, wait) : start_job(context, request);
}

}  // namespace

void add_match_post_routes(Router& router, const ServerContext& context) {
  router.add(
      "POST", "/match", [&context](HttpRequest& request) { return post_match(context, request); }, Body::json);
}

}  // namespace spherematch
