// Files of one shape: its upload, its spherical parametrisation, its signals.
#include <array>
#include <string>

#include "engine/io/map_writer.h"
#include "engine/io/mesh_reader.h"
#include "engine/io/mesh_writer.h"
#include "engine/io/shape_files.h"
#include "server/conditional.h"
#include "server/negotiation.h"
#include "server/request_parameters.h"
#include "server/server_context.h"

namespace spherematch {

namespace {

constexpr std::array<Representation, 6> mesh_representations{{
    {"original", "application/octet-stream"},  // the answer names the upload's own type
    {"off", "application/x-off"},
    {"obj", "model/obj"},
    {"ply", "application/x-ply"},
    {"stl", "model/stl"},
    {"glb", "model/gltf-binary"},
}};
constexpr std::array<Representation, 2> sphere_representations{{{"npy", "application/x-npy"}, {"ply", "application/x-ply"}}};
constexpr std::array<Representation, 2> hks_representations{{{"npz", "application/x-npz"}, {"npy", "application/x-npy"}}};

HttpResponse file_response(std::string_view media_type, std::string body) {
  return {.status = 200, .content_type = std::string(media_type), .body = std::move(body), .headers = {}};
}

std::string_view media_type_of(std::string_view format) {
  if (format == "gltf") return "model/gltf+json";
  for (const Representation& known : mesh_representations) {
    if (known.format == format) return known.media_type;
  }
  return mesh_representations.front().media_type;
}

HttpResponse original_file(const ServerContext& context, const std::string& id) {
  const ShapeService::StoredUpload upload = context.shapes.load_upload(id);
  // By the content once more, for the format kept with an upload of an older release is what its name ends in.
  const std::string_view format = mesh_format_of(upload.bytes, "." + upload.format);
  return file_response(media_type_of(format), {reinterpret_cast<const char*>(upload.bytes.data()), upload.bytes.size()});
}

HttpResponse get_mesh(const ServerContext& context, const HttpRequest& request) {
  const RequestParameters parameters(request, {"format"});
  const Representation& chosen = choose_representation(parameters.text("format"), request.header("accept"), mesh_representations);
  context.shapes.require_known(request.id);
  const std::string etag = weak_etag({"mesh", request.id, context.engine.version(), chosen.format});
  return answer_unless_known(request, etag, [&] {
    const Gate::Permit permit = context.matches.enter();
    const auto format = mesh_format_named(chosen.format);
    if (!format) return original_file(context, request.id);
    return file_response(chosen.media_type, encode_mesh(*format, context.shapes.load_mesh(request.id)));
  });
}

HttpResponse get_sphere(const ServerContext& context, const HttpRequest& request) {
  const RequestParameters parameters(request, {"format", "wait"});
  const Representation& chosen = choose_representation(parameters.text("format"), request.header("accept"), sphere_representations);
  const auto wait = parameters.seconds("wait", 0, max_wait_seconds);
  context.shapes.require_usable(request.id);
  const std::string etag = weak_etag({"sphere", request.id, context.engine.version(), chosen.format});
  return answer_unless_known(request, etag, [&] {
    context.shapes.require_ready(request.id, ShapeService::Clock::now() + wait);
    const ShapePointer shape = context.shapes.load(request.id);
    if (chosen.format == "npy") return file_response(chosen.media_type, encode_npy(uploaded_sphere(*shape)));
    const Gate::Permit permit = context.matches.enter();
    return file_response(chosen.media_type, encode_sphere_ply(context.shapes.load_mesh(request.id), *shape));
  });
}

HttpResponse get_hks(const ServerContext& context, const HttpRequest& request) {
  const RequestParameters parameters(request, {"format", "wait"});
  const Representation& chosen = choose_representation(parameters.text("format"), request.header("accept"), hks_representations);
  const auto wait = parameters.seconds("wait", 0, max_wait_seconds);
  context.shapes.require_usable(request.id);
  const std::string etag = weak_etag({"hks", request.id, context.engine.version(), chosen.format});
  return answer_unless_known(request, etag, [&] {
    context.shapes.require_ready(request.id, ShapeService::Clock::now() + wait);
    const ShapePointer shape = context.shapes.load(request.id, PreparedParts::all);
    return file_response(chosen.media_type, chosen.format == "npz" ? encode_hks_npz(*shape) : encode_hks_npy(*shape));
  });
}

}  // namespace

void add_derived_routes(Router& router, const ServerContext& context) {
  const auto bind = [&context](auto handler) { return [&context, handler](HttpRequest& request) { return handler(context, request); }; };
  router.add("GET", "/shapes/{id}/mesh", bind(get_mesh));
  router.add("GET", "/shapes/{id}/sphere", bind(get_sphere));
  router.add("GET", "/shapes/{id}/hks", bind(get_hks));
}

}  // namespace spherematch
