// Finds the handler of a request, and turns whatever a handler throws into a problem response.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "server/http_message.h"

namespace spherematch {

enum class Body { none, upload };

/// Routes are added before the first request; after that every function is thread-safe.
class Router {
 public:
  struct Route {
    std::string method;
    std::string pattern;  ///< for example "/shapes/{id}/sphere"; {id} stands for one non-empty segment
    Body body = Body::none;
    Handler handler;
  };

  void add(std::string method, std::string pattern, Handler handler, Body body = Body::none);

  /// Fills request.id. HEAD finds the GET route.
  /// @throws ProblemError(not_found), ProblemError(method_not_allowed) with an Allow header
  const Route& find(HttpRequest& request) const;

  /// Answers in every case. `read_body` is called for a route that takes a body, before the handler.
  [[nodiscard]] HttpResponse handle(HttpRequest& request, const std::function<void(HttpRequest&)>& read_body) const;

  /// The pattern that the path fits, for logs; "-" when there is none.
  [[nodiscard]] std::string_view pattern_of(std::string_view path) const;

  /// Patterns of the routes that take a body.
  [[nodiscard]] std::vector<std::string> upload_patterns() const;

 private:
  std::vector<Route> routes_;
};

}  // namespace spherematch
