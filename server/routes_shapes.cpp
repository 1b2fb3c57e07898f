// POST, GET and DELETE of shapes.
#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "api/json.h"
#include "server/conditional.h"
#include "server/problem.h"
#include "server/request_parameters.h"
#include "server/server_context.h"
#include "server/shape_labels.h"

namespace spherematch {

namespace {

constexpr std::array<std::string_view, 4> states{"queued", "processing", "ready", "failed"};
constexpr std::array<std::string_view, 2> repair_modes{"fill", "none"};

HttpResponse json_response(int status, const api::Json& json) {
  return {.status = status, .content_type = "application/json", .body = api::to_text(json) + "\n", .headers = {}};
}

/// A given name is refused when it cannot be kept as it is; the name of an uploaded file is made to fit.
ShapeLabels labels_of(const RequestParameters& parameters, const std::string& file_name) {
  ShapeLabels labels;
  labels.name = parameters.text("name").value_or(name_of_file(file_name));
  check_name(labels.name);
  labels.tags = parse_tags(parameters.text("tags").value_or(""));
  return labels;
}

/// curl calls every body a form unless told otherwise, so the name says nothing until the content is no mesh.
std::string form_advice(const HttpRequest& request, std::string_view bytes, ErrorCode code) {
  if (!request.header("content-type").starts_with("application/x-www-form-urlencoded")) return {};
  if (code == ErrorCode::unsupported_format) {
    return "; the body seems to be the fields of a form: send the file itself, as curl --data-binary @FILE or curl -F file=@FILE do";
  }
  if (code == ErrorCode::malformed_mesh && !bytes.empty() && bytes.find('\n') == std::string_view::npos) {
    return "; the body has no line ends, as curl -d @FILE takes them out: use curl --data-binary @FILE";
  }
  return {};
}

ReadOptions read_options(const RequestParameters& parameters) {
  ReadOptions options;
  if (parameters.choice("repair", repair_modes) == "none") options.repair = RepairMode::none;
  if (parameters.text("simplify")) {
    options.simplify =
        static_cast<std::int32_t>(parameters.integer("simplify", 0, ReadOptions::least_simplify, std::numeric_limits<std::int32_t>::max()));
  }
  return options;
}

ShapeService::Posted post_upload(const ServerContext& context, const HttpRequest& request, const RequestBody& upload,
                                 const ShapeLabels& labels, const ReadOptions& options) {
  try {
    const std::string& file_name = upload.file_name.empty() ? labels.name : upload.file_name;
    return context.shapes.post(std::as_bytes(std::span(upload.bytes)), labels, file_name, options);
  } catch (const EngineError& error) {
    const std::string advice = form_advice(request, upload.bytes, error.code());
    if (advice.empty()) throw;
    throw EngineError(error.code(), error.what() + advice, error.elements());
  }
}

HttpResponse post_shape(const ServerContext& context, HttpRequest& request) {
  const RequestParameters parameters(request, {"name", "repair", "simplify", "wait", "tags"});
  const ShapeLabels labels = labels_of(parameters, request.body.file_name);
  const ReadOptions options = read_options(parameters);
  const auto wait = parameters.seconds("wait", 0, max_wait_seconds);

  auto upload = std::make_unique<RequestBody>(std::exchange(request.body, {}));
  const auto [id, known] = post_upload(context, request, *upload, labels, options);
  upload.reset();  // the wait may be long, and others may need the memory
  context.shapes.wait_until_finished(id, ShapeService::Clock::now() + wait);

  const api::Shape shape = context.shapes.get(id);
  HttpResponse response = json_response(known ? 200 : shape.state == api::ShapeState::ready ? 201 : 202, api::to_json(shape));
  response.headers.emplace_back("Location", "/shapes/" + shape.id);
  return response;
}

/// What a page leaves out. A filter without a value filters nothing.
ShapeFilter filter_of(const RequestParameters& parameters) {
  ShapeFilter filter;
  if (!parameters.text("state").value_or("").empty()) {
    const std::string state = parameters.choice("state", states);
    filter.state = static_cast<ShapeState>(std::find(states.begin(), states.end(), state) - states.begin());
  }
  filter.tag = parameters.text("tag").value_or("");
  if (!filter.tag.empty()) check_tags({filter.tag});
  filter.name_part = parameters.text("q").value_or("");
  filter.sha256 = parameters.text("sha256").value_or("");
  for (char& c : filter.sha256) {
    if (c >= 'A' && c <= 'F') c = static_cast<char>(c - 'A' + 'a');
  }
  const bool digits_only = filter.sha256.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!filter.sha256.empty() && (filter.sha256.size() != 64 || !digits_only)) {
    throw ProblemError(api::Code::invalid_parameter, "sha256: must be 64 hexadecimal digits");
  }
  return filter;
}

HttpResponse list_shapes(const ServerContext& context, const HttpRequest& request) {
  const RequestParameters parameters(request, {"limit", "cursor", "state", "tag", "q", "sha256"});
  const auto limit = static_cast<std::size_t>(parameters.integer("limit", 50, 1, 200));
  const api::ShapePage page = context.shapes.list(limit, parameters.text("cursor"), filter_of(parameters));
  HttpResponse response = json_response(200, api::to_json(page));
  if (page.next_cursor) {
    std::string next = "/shapes?limit=" + std::to_string(limit) + "&cursor=" + *page.next_cursor;
    for (const std::string_view name : {"state", "tag", "q", "sha256"}) {
      if (const auto value = parameters.text(name)) next.append("&").append(name).append("=").append(percent_encoded(*value));
    }
    response.headers.emplace_back("Link", "<" + next + ">; rel=\"next\"");
  }
  return response;
}

std::string etag_of(const api::Shape& shape) { return weak_etag({"shape", api::to_text(api::to_json(shape))}); }

HttpResponse get_shape(const ServerContext& context, const HttpRequest& request) {
  const RequestParameters parameters(request, {});
  const api::Shape shape = context.shapes.get(request.id);
  HttpResponse response = json_response(200, api::to_json(shape));
  const std::string etag = etag_of(shape);
  if (names_etag(request.header("if-none-match"), etag)) response = {.status = 304, .content_type = {}, .body = {}, .headers = {}};
  response.headers.emplace_back("ETag", etag);
  response.headers.emplace_back("Cache-Control", "private, no-cache");
  return response;
}

api::ShapePatch parse_patch(const HttpRequest& request) {
  try {
    api::ShapePatch patch = api::from_text<api::ShapePatch>(request.body.bytes);
    if (patch.name) check_name(*patch.name);
    if (patch.tags) check_tags(*patch.tags);
    return patch;
  } catch (const api::JsonError& error) {
    throw ProblemError(api::Code::invalid_parameter, error.what());
  }
}

HttpResponse patch_shape(const ServerContext& context, const HttpRequest& request) {
  const RequestParameters parameters(request, {});
  const api::ShapePatch patch = parse_patch(request);
  // A weak comparison, as all our tags are weak; it still tells whether somebody else made a change in between.
  const std::string expected = request.header("if-match");
  const auto unchanged = [&](const api::Shape& shape) { return expected.empty() || names_etag(expected, etag_of(shape)); };
  const api::Shape shape = context.shapes.change(request.id, {.name = patch.name, .tags = patch.tags}, unchanged);
  HttpResponse response = json_response(200, api::to_json(shape));
  response.headers.emplace_back("ETag", etag_of(shape));
  return response;
}

HttpResponse delete_shape(const ServerContext& context, const HttpRequest& request) {
  const RequestParameters parameters(request, {});
  context.shapes.remove(request.id);
  context.match_service.forget(request.id);
  return {.status = 204, .content_type = {}, .body = {}, .headers = {}};
}

}  // namespace

void add_shape_routes(Router& router, const ServerContext& context) {
  const auto bind = [&context](auto handler) { return [&context, handler](HttpRequest& request) { return handler(context, request); }; };
  router.add("POST", "/shapes", bind(post_shape), Body::upload);
  router.add("GET", "/shapes", bind(list_shapes));
  router.add("GET", "/shapes/{id}", bind(get_shape));
  router.add("PATCH", "/shapes/{id}", bind(patch_shape), Body::json);
  router.add("DELETE", "/shapes/{id}", bind(delete_shape));
}

}  // namespace spherematch
