// The page: its document at /, its other files below /page/.
#include <algorithm>

#include "server/conditional.h"
#include "server/problem.h"
#include "server/request_parameters.h"
#include "server/server_context.h"
#include "web/page_files.h"

namespace spherematch {

namespace {

/// At / of a server that was built without the page.
constexpr std::string_view plain_page = R"(<!doctype html>
<html lang="en">
<head><meta charset="utf-8"><title>Spherematch</title></head>
<body>
<h1>Spherematch</h1>
<p>Dense point-to-point correspondence between genus-zero surfaces. This server was built without its page.</p>
<p><a href="/docs">/docs</a> lists every operation, parameter and answer; <a href="/shapes">/shapes</a> what is stored.</p>
<pre>
curl --data-binary @a.off 'SERVER/shapes?name=a&amp;wait=60'
curl 'SERVER/match?src=ID_A&amp;tgt=ID_B&amp;format=npz' -o map.npz
</pre>
</body>
</html>
)";

/// Everything comes from this server, and nothing of it stands within the document.
constexpr const char* policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

constexpr const char* revalidated = "no-cache";
constexpr const char* forever = "public, max-age=31536000, immutable";

const PageFile* find(std::string_view name) {
  const auto files = page_files();
  const auto found = std::find_if(files.begin(), files.end(), [&](const PageFile& file) { return file.name == name; });
  return found == files.end() ? nullptr : &*found;
}

bool takes_gzip(const HttpRequest& request) { return request.header("accept-encoding").find("gzip") != std::string::npos; }

HttpResponse answer(const PageFile& file, const HttpRequest& request, const char* caching) {
  const std::string etag = weak_etag({file.name, file.bytes});
  HttpResponse response{.status = 200, .content_type = std::string(file.content_type), .body = {}, .headers = {}};
  if (names_etag(request.header("if-none-match"), etag)) {
    response = {.status = 304, .content_type = {}, .body = {}, .headers = {}};
  } else if (takes_gzip(request)) {
    response.body = file.gzip;
    response.headers.emplace_back("Content-Encoding", "gzip");
  } else {
    response.body = file.bytes;
  }
  for (const auto& [name, value] :
       {std::pair("ETag", etag.c_str()), std::pair("Cache-Control", caching), std::pair("Vary", "Accept-Encoding")})
    response.headers.emplace_back(name, value);
  return response;
}

HttpResponse get_document(const HttpRequest& request) {
  const RequestParameters parameters(request, {});
  const PageFile* file = find("index.html");
  if (file == nullptr) return {.status = 200, .content_type = "text/html; charset=utf-8", .body = std::string(plain_page), .headers = {}};
  HttpResponse response = answer(*file, request, revalidated);
  response.headers.emplace_back("Content-Security-Policy", policy);
  response.headers.emplace_back("Referrer-Policy", "no-referrer");
  return response;
}

/// The document asks for its files under `v`, which changes with their content: such an answer may be kept for good.
HttpResponse get_file(const HttpRequest& request) {
  const RequestParameters parameters(request, {"v"});
  const PageFile* file = find(request.id);
  if (file == nullptr || file == page_files().data()) throw ProblemError(api::Code::not_found, "the page has no such file");
  const std::string version = parameters.text("v").value_or("");
  const bool current = !version.empty() && page_files().front().bytes.find("?v=" + version + "\"") != std::string_view::npos;
  return answer(*file, request, current ? forever : revalidated);
}

}  // namespace

void add_page_routes(Router& router) {
  router.add("GET", "/", [](HttpRequest& request) { return get_document(request); });
  router.add("GET", "/page/{id}", [](HttpRequest& request) { return get_file(request); });
}

}  // namespace spherematch
