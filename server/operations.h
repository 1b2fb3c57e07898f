// What those who run the server look at, and where it is hooked in: keys, metrics, readiness.
#pragma once

#include <optional>
#include <string>

#include "server/access.h"
#include "server/background_check.h"
#include "server/http_server.h"
#include "server/metrics.h"
#include "server/readiness.h"
#include "server/server_context.h"
#include "storage/shape_store.h"

namespace spherematch {

/// Outlives the router and the server that it is hooked into.
class Operations {
 public:
  /// Both references must outlive this.
  Operations(Access& access, ShapeStore& store, const std::string& version, const std::string& engine);

  [[nodiscard]] Metrics& metrics() { return metrics_; }

  /// The guard, /metrics and /readyz. Once; the context must outlive the router.
  void add_to(Router& router, const ServerContext& context);

  /// Who the log names, and the metrics of requests.
  void add_to(HttpServerSettings& settings);

 private:
  Access& access_;
  Metrics metrics_;
  Readiness readiness_;
  BackgroundCheck writes_;
};

}  // namespace spherematch
