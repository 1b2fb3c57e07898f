#include "server/router.h"

#include <algorithm>

#include "server/problem.h"

namespace spherematch {

namespace {

constexpr std::string_view placeholder = "{id}";
constexpr std::size_t max_id_bytes = 128;

/// The text in place of {id}, empty where the pattern has none; nothing when the path does not fit.
std::optional<std::string_view> fit(std::string_view pattern, std::string_view path) {
  const auto at = pattern.find(placeholder);
  if (at == std::string_view::npos) return pattern == path ? std::optional(std::string_view()) : std::nullopt;
  const std::string_view tail = pattern.substr(at + placeholder.size());
  if (!path.starts_with(pattern.substr(0, at))) return std::nullopt;
  path.remove_prefix(at);
  if (!path.ends_with(tail)) return std::nullopt;
  path.remove_suffix(tail.size());
  if (path.empty() || path.size() > max_id_bytes || path.find('/') != std::string_view::npos) return std::nullopt;
  return path;
}

}  // namespace

void Router::add(std::string method, std::string pattern, Handler handler, Body body) {
  routes_.push_back({std::move(method), std::move(pattern), body, std::move(handler)});
}

const Router::Route& Router::find(HttpRequest& request) const {
  const std::string_view wanted = request.method == "HEAD" ? std::string_view("GET") : std::string_view(request.method);
  std::string allow;
  for (const Route& route : routes_) {
    const auto id = fit(route.pattern, request.path);
    if (!id) continue;
    if (route.method == wanted) {
      request.id = *id;
      return route;
    }
    allow.append(allow.empty() ? "" : ", ").append(route.method == "GET" ? "GET, HEAD" : route.method);
  }
  if (allow.empty()) throw ProblemError(api::Code::not_found, "there is nothing at this path; GET / names what exists");
  api::Problem problem;
  problem.code = api::Code::method_not_allowed;
  problem.detail = "this resource has " + allow;
  throw ProblemError(problem, {{"Allow", allow}});
}

std::optional<HttpResponse> Router::refusal(const HttpRequest& request) const {
  try {
    if (guard_) guard_(request, pattern_of(request.path));
    return std::nullopt;
  } catch (...) {
    return problem_response(problem_of(std::current_exception()), request.request_id);
  }
}

HttpResponse Router::handle(HttpRequest& request, const ReadBody& read_body) const {
  if (auto refused = refusal(request)) return *std::move(refused);
  try {
    const Route& route = find(request);
    if (route.body != Body::none) read_body(request, route.body);
    return route.handler(request);
  } catch (...) {
    return problem_response(problem_of(std::current_exception()), request.request_id);
  }
}

std::string_view Router::pattern_of(std::string_view path) const {
  const auto found = std::find_if(routes_.begin(), routes_.end(), [&](const Route& route) { return fit(route.pattern, path).has_value(); });
  return found == routes_.end() ? std::string_view("-") : std::string_view(found->pattern);
}

Body Router::body_of(std::string_view method, std::string_view path) const {
  const auto found = std::find_if(routes_.begin(), routes_.end(),
                                  [&](const Route& route) { return route.method == method && fit(route.pattern, path).has_value(); });
  return found == routes_.end() ? Body::none : found->body;
}

}  // namespace spherematch
