// What the server says of itself.
#include "api/json.h"
#include "engine/io/map_format.h"
#include "server/parameters_json.h"
#include "server/request_parameters.h"
#include "server/server_context.h"

namespace spherematch {

namespace {

constexpr std::string_view start_page = R"(<!doctype html>
<html lang="en">
<head><meta charset="utf-8"><title>Spherematch</title></head>
<body>
<h1>Spherematch</h1>
<p>Dense point-to-point correspondence between genus-zero surfaces.</p>
<ul>
<li><a href="/shapes">/shapes</a>: what is stored; POST a mesh here</li>
<li>/shapes/{id}, /shapes/{id}/mesh, /shapes/{id}/sphere, /shapes/{id}/hks: one shape, its upload, its spherical parametrisation, its signals</li>
<li>/shapes/{id}/symmetry: its bilateral symmetry, a map to itself</li>
<li>/match?src={id}&amp;tgt={id}: the map from one shape to another</li>
<li>/evaluations: POST two shapes and what is known of their correspondence, get how good the match is</li>
<li>/transfer?src={id}&amp;tgt={id}: POST an array of values at the vertices of tgt, get it for those of src</li>
<li>/scene?src={id}&amp;tgt={id}: both meshes, corresponding points in one colour</li>
<li><a href="/healthz">/healthz</a>, <a href="/readyz">/readyz</a>, <a href="/version">/version</a>, /metrics: the server itself</li>
<li><a href="/docs">/docs</a>, <a href="/openapi.json">/openapi.json</a>: every operation, parameter and answer</li>
</ul>
<pre>
curl --data-binary @a.off 'SERVER/shapes?name=a&amp;wait=60'
curl 'SERVER/match?src=ID_A&amp;tgt=ID_B&amp;format=npz' -o map.npz
</pre>
</body>
</html>
)";

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

HttpResponse get_start_page(const HttpRequest& request) {
  const RequestParameters parameters(request, {});
  return {.status = 200, .content_type = "text/html; charset=utf-8", .body = std::string(start_page), .headers = {}};
}

}  // namespace

void add_system_routes(Router& router, const ServerContext& context) {
  router.add("GET", "/", [](HttpRequest& request) { return get_start_page(request); });
  router.add("GET", "/healthz", [&context](HttpRequest& request) { return get_health(context, request); });
  router.add("GET", "/version", [&context](HttpRequest& request) { return get_version(context, request); });
}

}  // namespace spherematch
