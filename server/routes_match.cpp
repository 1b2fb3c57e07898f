// GET /match: the map between two shapes.
#include <array>
#include <optional>
#include <utility>

#include "api/json.h"
#include "engine/io/map_format.h"
#include "server/conditional.h"
#include "server/match_response.h"
#include "server/negotiation.h"
#include "server/parameters_json.h"
#include "server/problem.h"
#include "server/request_parameters.h"
#include "server/server_context.h"

namespace spherematch {

namespace {

constexpr std::array<Representation, 8> representations{{
    {"json", "application/json"},  // the others are named as in engine/io/map_format.h
    {"npz", "application/x-npz"},
    {"npy", "application/x-npy"},
    {"txt", "text/plain"},
    {"ply", "application/x-ply"},
    {"glb", "model/gltf-binary"},
    {"obj", "model/obj"},
    {"png", "image/png"},
}};
constexpr std::array<std::string_view, 2> methods{"default", "paper"};
constexpr std::array<std::string_view, 2> cache_modes{"yes", "no"};

struct MatchQuery {
  std::string src;
  std::string tgt;
  const Representation* representation = nullptr;
  MatchFields fields;
  MatchParameters parameters;
  std::chrono::milliseconds wait{};
};

MatchQuery parse_query(const HttpRequest& request) {
  const RequestParameters parameters(request, {"src", "tgt", "format", "fields", "wait", "cache", "method"});
  MatchQuery query;
  query.src = parameters.required("src");
  query.tgt = parameters.required("tgt");
  query.representation = &choose_representation(parameters.text("format"), request.header("accept"), representations);
  if (const auto fields = parameters.text("fields")) {
    if (query.representation->format != "json") {
      throw ProblemError(api::Code::invalid_parameter, "fields: applies to JSON only; the other formats are whole");
    }
    query.fields = parse_fields(*fields);
  }
  query.wait = parameters.seconds("wait", 30, max_wait_seconds);
  if (parameters.choice("method", methods) == "paper") query.parameters = MatchParameters::paper();
  // Nothing keeps results yet, so both values mean a fresh computation; the value is checked all the same.
  (void)parameters.choice("cache", cache_modes);
  return query;
}

std::string etag_of(const ServerContext& context, const MatchQuery& query) {
  return weak_etag({"match", query.src, query.tgt, to_json(query.parameters).dump(), context.engine.version(), query.representation->format,
                    canonical(query.fields)});
}

std::string encode_json(const ServerContext& context, const MatchQuery& query, const MatchResult& result, std::int32_t n_tgt) {
  api::Match match = match_of(result, query.fields);
  match.src = query.src;
  match.tgt = query.tgt;
  match.n_tgt = n_tgt;
  match.engine = context.engine.version();
  return api::to_text(api::to_json(match)) + "\n";
}

HttpResponse compute(const ServerContext& context, const MatchQuery& query) {
  const auto deadline = ShapeService::Clock::now() + query.wait;
  context.shapes.require_ready(query.src, deadline);
  context.shapes.require_ready(query.tgt, deadline);
  // Only from here on is memory and time spent, so the bound stands here and waiting for a preparation takes no slot.
  const Gate::Permit permit = context.matches.enter();
  const ShapePointer source = context.shapes.load(query.src);
  const ShapePointer target = context.shapes.load(query.tgt);
  const std::optional<MapFormat> format = map_format_of(query.representation->format);
  PolygonMesh source_mesh;  // before the match, so that a shape that is removed meanwhile does not spoil the end
  if (format && needs_source_mesh(*format)) source_mesh = context.shapes.load_mesh(query.src);
  const MatchResult result = context.engine.match(*source, *target, query.parameters, {.report = {}, .stop = context.stop});
  return {.status = 200,
          .content_type = std::string(query.representation->media_type),
          .body = format ? encode_map(*format, result.map, source->surface, target->surface, std::move(source_mesh))
                         : encode_json(context, query, result, target->surface.uploaded_vertices()),
          .headers = {{"Server-Timing", server_timing(result.seconds)}}};
}

HttpResponse get_match(const ServerContext& context, const HttpRequest& request) {
  const MatchQuery query = parse_query(request);
  context.shapes.require_usable(query.src);
  context.shapes.require_usable(query.tgt);
  const std::string etag = etag_of(context, query);
  HttpResponse response{.status = 304, .content_type = {}, .body = {}, .headers = {}};
  if (!names_etag(request.header("if-none-match"), etag)) response = compute(context, query);
  response.headers.emplace_back("ETag", etag);
  response.headers.emplace_back("Cache-Control", "private, no-cache");
  response.headers.emplace_back("Vary", "Accept");
  return response;
}

}  // namespace

void add_match_routes(Router& router, const ServerContext& context) {
  router.add("GET", "/match", [&context](HttpRequest& request) { return get_match(context, request); });
}

}  // namespace spherematch
