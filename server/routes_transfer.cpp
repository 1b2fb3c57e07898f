// POST /transfer: what is known at the vertices of one shape, carried along the map to the vertices of another.
#include <array>
#include <optional>
#include <utility>

#include "engine/io/array_reader.h"
#include "engine/io/array_writer.h"
#include "engine/io/map_picture.h"
#include "engine/io/transfer.h"
#include "engine/io/vertex_data.h"
#include "server/match_query.h"
#include "server/negotiation.h"
#include "server/problem.h"
#include "server/request_parameters.h"
#include "server/server_context.h"

namespace spherematch {

namespace {

constexpr std::array<Representation, 4> representations{
    {{"npy", "application/x-npy"}, {"ply", "application/x-ply"}, {"glb", "model/gltf-binary"}, {"png", "image/png"}}};
constexpr std::array<std::string_view, 5> meaning_names{"color", "texture", "label", "value", "weights"};
constexpr std::array<std::string_view, 2> interpolations{"linear", "nearest"};  // in the order of Interpolation

/// @throws ProblemError(invalid_parameter) also for what the array cannot be
Interpolation interpolation_of(const RequestParameters& parameters, const Array& array) {
  if (!parameters.text("interp")) return is_floating(array) ? Interpolation::linear : Interpolation::nearest;
  const auto chosen = parameters.choice("interp", interpolations) == "linear" ? Interpolation::linear : Interpolation::nearest;
  check_interpolation(array, chosen);
  return chosen;
}

[[noreturn]] void refuse(api::Code code, std::string detail, std::int64_t limit, std::int64_t actual) {
  api::Problem problem;
  problem.code = code;
  problem.detail = std::move(detail);
  problem.limit = limit;
  problem.actual = actual;
  throw ProblemError(problem);
}

/// The array must fit the target, and the answer in bounds: a few wide rows can become very many.
void check_sizes(const ServerContext& context, const MatchQuery& query, const Array& array) {
  constexpr std::size_t answer_to_body = 4;
  const std::int64_t n_tgt = context.shapes.get(query.tgt).vertices;
  if (array.rows() != n_tgt) {
    refuse(api::Code::length_mismatch,
           "the array has " + std::to_string(array.rows()) + " rows, tgt has " + std::to_string(n_tgt) + " uploaded vertices", n_tgt,
           array.rows());
  }
  const auto limit = static_cast<std::int64_t>(answer_to_body * context.options.max_body_bytes());
  // Both factors are bounded: a row by the body, the vertices by the store.
  const std::int64_t size = static_cast<std::int64_t>(array.row_bytes()) * context.shapes.get(query.src).vertices;
  if (size > limit) {
    refuse(api::Code::payload_too_large, "the answer would have " + std::to_string(size) + " bytes; send fewer columns at a time", limit,
           size);
  }
}

/// Nothing where the answer is the array itself.
std::optional<Meaning> meaning_of(const RequestParameters& parameters, std::string_view format, const Array& array) {
  const auto name = parameters.text("as");
  const std::optional<Meaning> meaning = name ? meaning_named(parameters.choice("as", meaning_names)) : std::nullopt;
  if (format == "npy") {
    if (name) throw ProblemError(api::Code::invalid_parameter, "as: applies to ply, glb and png only");
    return std::nullopt;
  }
  if (!meaning) return likely_meaning(array);
  check_meaning(*meaning, array);
  return meaning;
}

/// Source and target as they were prepared and the source as it was uploaded, as far as the format needs them.
std::string encode(const ServerContext& context, const MatchQuery& query, std::string_view format, const std::optional<Meaning>& meaning,
                   const Array& array, const Array& carried, const Correspondence& map) {
  if (!meaning) return encode_npy(carried);
  const VertexDataPair data = vertex_data(*meaning, carried, array, map);
  if (format == "png") return encode_png(data, map, context.shapes.load(query.src)->surface, context.shapes.load(query.tgt)->surface);
  const PolygonMesh mesh = context.shapes.load_mesh(query.src);
  return format == "ply" ? encode_ply(mesh, data.source) : encode_glb(mesh, data.source);
}

HttpResponse post_transfer(const ServerContext& context, HttpRequest& request) {
  const RequestParameters parameters(request,
                                     {"src", "tgt", "interp", "format", "as", "wait", "cache", "method", "refine", "orientation", "hints"});
  const MatchQuery query = match_query_of(parameters);
  const Representation& chosen = choose_representation(parameters.text("format"), request.header("accept"), representations);
  const MatchService::Cache cache = cache_of(parameters);
  const auto wait = parameters.seconds("wait", 30, max_wait_seconds);
  context.shapes.require_usable(query.src);
  context.shapes.require_usable(query.tgt);

  const RequestBody body = std::exchange(request.body, {});  // its permit counts for the array
  const Array array = decode_npy(body.bytes);
  const Interpolation interpolation = interpolation_of(parameters, array);
  const std::optional<Meaning> meaning = meaning_of(parameters, chosen.format, array);
  check_sizes(context, query, array);
  await_shapes(context.shapes, query, wait);
  const MatchAnswer answer = context.match_service.get(query, cache);

  const Gate::Permit permit = context.matches.enter();
  return {
      .status = 200,
      .content_type = std::string(chosen.media_type),
      .body = encode(context, query, chosen.format, meaning, array, transfer(array, answer.result->map, interpolation), answer.result->map),
      .headers = {{"Server-Timing", server_timing(answer)}, {"Cache-Control", "no-store"}}};
}

}  // namespace

void add_transfer_routes(Router& router, const ServerContext& context) {
  router.add(
      "POST", "/transfer", [&context](HttpRequest& request) { return post_transfer(context, request); }, Body::array);
}

}  // namespace spherematch
