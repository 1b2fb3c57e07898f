// /metrics and /readyz, for those who run the server.
#pragma once

#include <functional>

#include "server/metrics.h"
#include "server/readiness.h"
#include "server/router.h"

namespace spherematch {

/// Both must outlive the router. `snapshot` is called with every scrape, from any thread.
void add_metrics_route(Router& router, const Metrics& metrics, std::function<MetricsSnapshot()> snapshot);

/// 200 with all checks, or the problem `not-ready` with them.
void add_readiness_route(Router& router, const Readiness& readiness);

}  // namespace spherematch
