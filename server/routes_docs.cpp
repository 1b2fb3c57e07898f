// The interface's own description.
#include <memory>

#include "api/json.h"
#include "server/api_document.h"
#include "server/conditional.h"
#include "server/request_parameters.h"
#include "server/server_context.h"

namespace spherematch {

namespace {

/// What never changes while the server runs.
struct FixedText {
  std::string content_type;
  std::string body;
  std::string etag;
};

HttpResponse answer(const FixedText& text, const HttpRequest& request) {
  const RequestParameters parameters(request, {});
  HttpResponse response{.status = 200, .content_type = text.content_type, .body = text.body, .headers = {}};
  if (names_etag(request.header("if-none-match"), text.etag)) response = {.status = 304, .content_type = {}, .body = {}, .headers = {}};
  response.headers = {{"ETag", text.etag}, {"Cache-Control", "no-cache"}};
  return response;
}

void add_fixed(Router& router, const std::string& path, std::string content_type, std::string body) {
  const std::string etag = weak_etag({path, body});
  const auto text = std::make_shared<const FixedText>(FixedText{std::move(content_type), std::move(body), etag});
  router.add("GET", path, [text](HttpRequest& request) { return answer(*text, request); });
}

}  // namespace

void add_docs_routes(Router& router) {
  const api::Json document = json_of_yaml(api_document_text());
  add_fixed(router, "/openapi.json", "application/json", api::to_text(document) + "\n");
  add_fixed(router, "/docs", "text/html; charset=utf-8", api_page(document));
}

}  // namespace spherematch
