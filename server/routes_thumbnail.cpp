// GET /shapes/{id}/thumbnail.png: what an uploaded shape looks like, in small.
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "engine/io/shape_picture.h"
#include "server/conditional.h"
#include "server/lru_cache.h"
#include "server/negotiation.h"
#include "server/problem.h"
#include "server/request_parameters.h"
#include "server/server_context.h"

namespace spherematch {

namespace {

constexpr std::array<Representation, 1> representations{{{"png", "image/png"}}};

/// Pages that list shapes ask for the same pictures again and again. An id speaks of bytes, so that a picture never goes stale: a shape
/// that was removed is refused before this is asked.
using Cache = LruCache<std::string>;
constexpr std::size_t cache_bytes = std::size_t{16} << 20;

struct ThumbnailRequest {
  int size = 0;
  std::optional<Viewpoint> view;
  std::string key;  ///< of all that makes the picture, but for the shape
};

constexpr std::array<std::string_view, 7> directions{"auto", "x", "y", "z", "-x", "-y", "-z"};

Eigen::Vector3d axis_named(std::string_view name) {
  const double sign = name.starts_with('-') ? -1 : 1;
  return sign * Eigen::Vector3d::Unit(name.back() - 'x');
}

ThumbnailRequest parse(const RequestParameters& parameters) {
  ThumbnailRequest request;
  request.size = static_cast<int>(parameters.integer("size", 256, least_thumbnail, largest_thumbnail));
  const std::string up = parameters.choice("up", directions);
  const std::string front = parameters.choice("front", directions);
  request.key = std::to_string(request.size) + ' ' + up + ' ' + front;
  if (up == "auto" && front == "auto") return request;
  if (up == "auto" || front == "auto" || up.back() == front.back())
    throw ProblemError(api::Code::invalid_parameter, "up, front: give both or none, and not along one axis");
  request.view = Viewpoint{.up = axis_named(up), .front = axis_named(front)};
  return request;
}

Cache::Pointer picture_of(const ServerContext& context, Cache& cache, const std::string& id, const ThumbnailRequest& wanted) {
  const std::string key = wanted.key + '/' + id;
  if (Cache::Pointer known = cache.find(key)) return known;
  const Gate::Permit permit = context.matches.enter();
  auto picture = std::make_shared<const std::string>(encode_thumbnail(context.shapes.load_mesh(id), wanted.size, wanted.view));
  cache.put(key, picture, picture->size());
  return picture;
}

HttpResponse get_thumbnail(const ServerContext& context, Cache& cache, const HttpRequest& request) {
  const RequestParameters parameters(request, {"size", "up", "front"});
  const ThumbnailRequest wanted = parse(parameters);
  const Representation& png = choose_representation({}, request.header("accept"), representations);
  context.shapes.require_known(request.id);
  const std::string etag = weak_etag({"thumbnail", request.id, context.engine.version(), wanted.key});
  return answer_unless_known(request, etag, [&] {
    return HttpResponse{
        .status = 200, .content_type = std::string(png.media_type), .body = *picture_of(context, cache, request.id, wanted), .headers = {}};
  });
}

}  // namespace

void add_thumbnail_routes(Router& router, const ServerContext& context) {
  const auto cache = std::make_shared<Cache>(cache_bytes);
  router.add("GET", "/shapes/{id}/thumbnail.png",
             [&context, cache](HttpRequest& request) { return get_thumbnail(context, *cache, request); });
}

}  // namespace spherematch
