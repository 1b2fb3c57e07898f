// What the server says of itself.
#include "api/json.h"
#include "engine/io/map_format.h"
#include "server/parameters_json.h"
#include "server/request_parameters.h"
#include "server/server_context.h"

namespace spherematch {

namespace {

HttpResponse json_response(const api::Json& json, std::string cache_control) {
  return {.status = 200,
          .content_type = "application/json",
          .body = api::to_text(json) + "\n",
          .headers = {{"Cache-Control", std::move(cache_control)}}};
}

HttpResponse get_health(const ServerContext& context, const HttpRequest& request) {
  const RequestParameters parameters(request, {});
  const JobRunner::Counts jobs = context.shapes.job_counts();
  const Gate::Counts matches = context.matches.counts();
  const api::Health health{.status = context.stop.stop_requested() ? "draining" : "ok",
                           .jobs_queued = static_cast<std::int64_t>(jobs.queued),
                           .jobs_processing = static_cast<std::int64_t>(jobs.running),
                           .matches_running = static_cast<std::int64_t>(matches.inside),
                           .matches_waiting = static_cast<std::int64_t>(matches.waiting)};
  return json_response(api::to_json(health), "no-store");
}

HttpResponse get_version(const ServerContext& context, const HttpRequest& request) {
  const RequestParameters parameters(request, {});
  const ServerOptions& options = context.options;
  api::Version version{.version = context.version,
                       .engine = context.engine.version(),
                       .limits = {.body_bytes = static_cast<std::int64_t>(options.max_body_bytes()),
                                  .vertices = options.max_vertices,
                                  .queued_jobs = options.max_queued_jobs,
                                  .concurrent_matches = options.concurrent_matches,
                                  .waiting_matches = options.waiting_matches,
                                  .concurrent_uploads = options.concurrent_uploads,
                                  .workers = options.workers,
                                  .threads = options.threads,
                                  .shape_cache_bytes = static_cast<std::int64_t>(options.shape_cache_mib) << 20,
                                  .match_cache_bytes = static_cast<std::int64_t>(options.match_cache_mib) << 20,
                                  .match_store_bytes = static_cast<std::int64_t>(options.match_store_mib) << 20,
                                  .wait_seconds = static_cast<std::int64_t>(max_wait_seconds)},
                       .mesh_formats = {"off", "obj", "ply", "stl", "gltf", "glb"},
                       .match_formats = {"json"},
                       .parameters = api::Json::object()};
  for (const std::string_view format : map_format_names()) version.match_formats.emplace_back(format);
  version.parameters["preprocess"] = to_json(PreprocessParameters{});
  version.parameters["match"] = to_json(MatchParameters{});
  version.parameters["match_paper"] = to_json(MatchParameters::paper());
  return json_response(api::to_json(version), "no-cache");
}

}  // namespace

void add_system_routes(Router& router, const ServerContext& context) {
  router.add("GET", "/healthz", [&context](HttpRequest& request) { return get_health(context, request); });
  router.add("GET", "/version", [&context](HttpRequest& request) { return get_version(context, request); });
}

}  // namespace spherematch
