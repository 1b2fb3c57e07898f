#include "server/routes_operations.h"

#include <algorithm>
#include <utility>

#include "api/json.h"
#include "server/problem.h"
#include "server/request_parameters.h"

namespace spherematch {

namespace {

constexpr const char* never_stored = "no-store";

HttpResponse get_metrics(const Metrics& metrics, const MetricsSnapshot& snapshot) {
  return {.status = 200,
          .content_type = "text/plain; version=0.0.4; charset=utf-8",
          .body = metrics.text(snapshot),
          .headers = {{"Cache-Control", never_stored}}};
}

HttpResponse get_readiness(const Readiness& readiness, const HttpRequest& request) {
  const RequestParameters parameters(request, {});
  std::vector<api::ReadinessCheck> checks = readiness.report();
  if (std::all_of(checks.begin(), checks.end(), [](const api::ReadinessCheck& check) { return check.ok; })) {
    return {.status = 200,
            .content_type = "application/json",
            .body = api::to_text(api::to_json(api::Readiness{std::move(checks)})) + "\n",
            .headers = {{"Cache-Control", never_stored}}};
  }
  api::Problem problem;
  problem.code = api::Code::not_ready;
  for (const api::ReadinessCheck& check : checks) {
    if (!check.ok) problem.detail += (problem.detail.empty() ? "" : "; ") + check.name + ": " + check.detail;
  }
  problem.checks = std::move(checks);
  return problem_response(ProblemError(problem, {{"Cache-Control", never_stored}}), request.request_id);
}

}  // namespace

void add_metrics_route(Router& router, const Metrics& metrics, std::function<MetricsSnapshot()> snapshot) {
  router.add("GET", "/metrics", [&metrics, snapshot = std::move(snapshot)](HttpRequest& request) {
    const RequestParameters parameters(request, {});
    return get_metrics(metrics, snapshot());
  });
}

void add_readiness_route(Router& router, const Readiness& readiness) {
  router.add("GET", "/readyz", [&readiness](HttpRequest& request) { return get_readiness(readiness, request); });
}

}  // namespace spherematch
