// GET /match: the map between two shapes. GET /shapes/{id}/symmetry: that of a shape to its mirror image.
#include <array>
#include <optional>
#include <utility>

#include "api/json.h"
#include "engine/io/map_format.h"
#include "engine/io/map_writer.h"
#include "server/conditional.h"
#include "server/match_query.h"
#include "server/match_response.h"
#include "server/negotiation.h"
#include "server/problem.h"
#include "server/request_parameters.h"
#include "server/server_context.h"

namespace spherematch {

namespace {

constexpr std::array<Representation, 9> representations{{
    {"json", "application/json"},  // the others are named as in engine/io/map_format.h
    {"npz", "application/x-npz"},
    {"npy", "application/x-npy"},
    {"txt", "text/plain"},
    {"map", "text/plain"},  // by its name only: where Accept says text, it is the one before
    {"ply", "application/x-ply"},
    {"glb", "model/gltf-binary"},
    {"obj", "model/obj"},
    {"png", "image/png"},
}};
constexpr std::array<std::string_view, 2> no_or_yes{"no", "yes"};

struct MatchRequest {
  MatchQuery query;
  const Representation* representation = nullptr;
  MatchFields fields;
  std::chrono::milliseconds wait{};
  MatchService::Cache cache = MatchService::Cache::use;
  bool ready = false;      ///< both shapes are
  std::int32_t n_tgt = 0;  ///< vertices of the target
};

/// JSON has the arrays that are named. Files have their map whole, and some what is named besides.
MatchFields fields_for(std::string_view format, std::string_view named) {
  const MatchFields fields = parse_fields(named);
  if (format == "json") return fields;
  if (!holds_quality(*map_format_of(format))) {
    throw ProblemError(api::Code::invalid_parameter, "fields: applies to json, npz and ply only; the other formats are whole");
  }
  if (fields.vertex || fields.corners || fields.bary) {
    throw ProblemError(api::Code::invalid_parameter,
                       "fields: npz and ply have their map whole; confidence and distortion are all that can be added to it");
  }
  return fields;
}

/// What both routes read of how to answer a query.
MatchRequest request_for(MatchQuery query, const HttpRequest& from, const RequestParameters& parameters) {
  MatchRequest request;
  request.query = std::move(query);
  request.representation = &choose_representation(parameters.text("format"), from.header("accept"), representations);
  if (const auto fields = parameters.text("fields")) request.fields = fields_for(request.representation->format, *fields);
  request.wait = parameters.seconds("wait", 30, max_wait_seconds);
  request.cache = cache_of(parameters);
  return request;
}

MatchRequest parse_match(const HttpRequest& from) {
  const RequestParameters parameters(
      from, {"src", "tgt", "format", "fields", "wait", "cache", "method", "refine", "orientation", "hints", "both", "candidate"});
  MatchRequest request = request_for(match_query_of(parameters), from, parameters);
  request.query.parameters.both = parameters.choice("both", no_or_yes) == "yes";
  const std::string_view format = request.representation->format;
  if (request.query.parameters.both && format != "json" && format != "npz") {
    throw ProblemError(api::Code::invalid_parameter, "both: applies to json and npz only; ask for the other direction by itself");
  }
  return request;
}

MatchRequest parse_symmetry(const HttpRequest& from) {
  const RequestParameters parameters(from, {"format", "fields", "wait", "cache", "method", "refine", "hints", "candidate"});
  return request_for(symmetry_query_of(from.id, parameters), from, parameters);
}

/// What an answer needs besides the map, read before the match: a shape that is removed meanwhile then does not spoil the end.
struct Ingredients {
  MatchedShapes shapes;     ///< for formats that draw surfaces, and fields of quality
  PolygonMesh source_mesh;  ///< for formats that repeat the upload
};

Ingredients gather(const ServerContext& context, const MatchRequest& request, const std::optional<MapFormat>& format) {
  Ingredients ingredients;
  if (request.fields.quality() || (format && needs_surfaces(*format))) {
    ingredients.shapes.source = context.shapes.load(request.query.src);
    ingredients.shapes.target = context.shapes.load(request.query.tgt);
  }
  if (format && needs_source_mesh(*format)) ingredients.source_mesh = context.shapes.load_mesh(request.query.src);
  return ingredients;
}

std::string encode(const ServerContext& context, const MatchRequest& request, const std::optional<MapFormat>& format,
                   const MatchAnswer& answer, Ingredients ingredients) {
  const MatchResult& result = *answer.result;
  if (!format) {
    const api::Match match = match_of(request.query, answer, request.fields, request.n_tgt, context.engine, ingredients.shapes);
    return api::to_text(api::to_json(match)) + "\n";
  }
  const auto& [source, target] = ingredients.shapes;
  VertexQuality quality = quality_of(result.map, request.fields, context.engine, source, target);
  if (*format == MapFormat::npz && request.query.parameters.both) {
    return encode_npz(result.map, result.reverse, quality, quality_of(result.reverse, request.fields, context.engine, target, source));
  }
  const Surface none;
  return encode_map(*format, result.map, source ? source->surface : none, target ? target->surface : none,
                    std::move(ingredients.source_mesh), std::move(quality));
}

HttpResponse compute(const ServerContext& context, const MatchRequest& request) {
  if (!request.ready) await_shapes(context.shapes, request.query, request.wait);
  const std::optional<MapFormat> format = map_format_of(request.representation->format);
  Ingredients ingredients = gather(context, request, format);
  const MatchAnswer answer = context.match_service.get(request.query, request.cache);
  return {.status = 200,
          .content_type = std::string(request.representation->media_type),
          .body = encode(context, request, format, answer, std::move(ingredients)),
          .headers = {{"Server-Timing", server_timing(answer)}}};
}

HttpResponse answer(const ServerContext& context, const HttpRequest& from, MatchRequest request) {
  context.match_service.require_room(request.query, request.cache);
  const auto src = context.shapes.require_usable(request.query.src);
  const auto tgt = context.shapes.require_usable(request.query.tgt);
  request.ready = src.ready && tgt.ready;
  request.n_tgt = tgt.vertices;
  const std::string etag =
      weak_etag({"match", context.match_service.key_of(request.query), request.representation->format, canonical(request.fields)});
  return answer_unless_known(from, etag, [&] { return compute(context, request); });
}

}  // namespace

void add_match_routes(Router& router, const ServerContext& context) {
  router.add("GET", "/match", [&context](HttpRequest& from) { return answer(context, from, parse_match(from)); });
  router.add("GET", "/shapes/{id}/symmetry", [&context](HttpRequest& from) { return answer(context, from, parse_symmetry(from)); });
}

}  // namespace spherematch
