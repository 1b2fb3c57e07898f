// Finds the handler of a request, and turns whatever a handler throws into a problem response.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/http_message.h"

namespace spherematch {

/// What a route takes as its body, and so how much of it is read and how.
enum class Body {
  none,
  json,    ///< a document of at most max_json_bytes
  array,   ///< bytes as they are, as many as an upload may have
  upload,  ///< a mesh: bytes as they are, or the multipart field `file`
};

/// Routes are added before the first request; after that every function is thread-safe.
class Router {
 public:
  /// Throws to refuse a request; `pattern` is as of pattern_of().
  using Guard = std::function<void(const HttpRequest& request, std::string_view pattern)>;

  struct Route {
    std::string method;
    std::string pattern;  ///< for example "/shapes/{id}/sphere"; {id} stands for one segment of 1 to 128 bytes
    Body body = Body::none;
    Handler handler;
  };

  void add(std::string method, std::string pattern, Handler handler, Body body = Body::none);

  /// Asked before everything else.
  void set_guard(Guard guard) { guard_ = std::move(guard); }

  /// What the guard has against the request, for those who must know before handle().
  [[nodiscard]] std::optional<HttpResponse> refusal(const HttpRequest& request) const;

  /// Fills request.id. HEAD finds the GET route.
  /// @throws ProblemError(not_found), ProblemError(method_not_allowed) with an Allow header
  const Route& find(HttpRequest& request) const;

  /// Reads the body into a request for a route that takes this kind of body.
  using ReadBody = std::function<void(HttpRequest&, Body)>;
  /// Answers in every case. `read_body` is called for a route that takes a body, before the handler.
  [[nodiscard]] HttpResponse handle(HttpRequest& request, const ReadBody& read_body) const;

  [[nodiscard]] const std::vector<Route>& routes() const { return routes_; }

  /// The pattern that the path fits, for logs; "-" when there is none.
  [[nodiscard]] std::string_view pattern_of(std::string_view path) const;

  /// What the route of this request takes; none where there is no such route.
  [[nodiscard]] Body body_of(std::string_view method, std::string_view path) const;

 private:
  std::vector<Route> routes_;
  Guard guard_;
};

}  // namespace spherematch
