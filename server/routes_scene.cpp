// GET /scene: both meshes of a pair side by side, corresponding points in one colour.
#include <array>
#include <utility>

#include "engine/io/scene.h"
#include "server/conditional.h"
#include "server/match_query.h"
#include "server/negotiation.h"
#include "server/request_parameters.h"
#include "server/server_context.h"

namespace spherematch {

namespace {

constexpr std::array<Representation, 1> representations{{{"glb", "model/gltf-binary"}}};

/// What the node of a shape is called: a shape may lack a name.
std::string node_name(const ServerContext& context, const std::string& id) {
  const std::string name = context.shapes.get(id).name;
  return name.empty() ? id : name;
}

HttpResponse make_scene(const ServerContext& context, const MatchQuery& query, const SceneNames& names, MatchService::Cache cache,
                        std::chrono::milliseconds wait) {
  await_shapes(context.shapes, query, wait);
  const ShapePointer target = context.shapes.load(query.tgt);
  const MatchAnswer answer = context.match_service.get(query, cache);
  // The meshes only now and behind the gate, for they take memory.
  const Gate::Permit permit = context.matches.enter();
  PolygonMesh source_mesh = context.shapes.load_mesh(query.src);
  const PolygonMesh target_mesh = context.shapes.load_mesh(query.tgt);
  return {.status = 200,
          .content_type = std::string(representations[0].media_type),
          .body = encode_scene(std::move(source_mesh), target_mesh, answer.result->map, target->surface, names),
          .headers = {{"Server-Timing", server_timing(answer)}}};
}

HttpResponse get_scene(const ServerContext& context, const HttpRequest& request) {
  const RequestParameters parameters(request, {"src", "tgt", "format", "wait", "cache", "method", "refine", "orientation", "hints"});
  const MatchQuery query = match_query_of(parameters);
  (void)choose_representation(parameters.text("format"), request.header("accept"), representations);
  const MatchService::Cache cache = cache_of(parameters);
  const auto wait = parameters.seconds("wait", 30, max_wait_seconds);
  context.shapes.require_usable(query.src);
  context.shapes.require_usable(query.tgt);
  const SceneNames names{node_name(context, query.src), node_name(context, query.tgt)};
  const std::string etag = weak_etag({"scene", context.match_service.key_of(query), names.source, names.target});
  return answer_unless_known(request, etag, [&] { return make_scene(context, query, names, cache, wait); });
}

}  // namespace

void add_scene_routes(Router& router, const ServerContext& context) {
  router.add("GET", "/scene", [&context](HttpRequest& request) { return get_scene(context, request); });
}

}  // namespace spherematch
