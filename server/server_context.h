// What the routes share. Owned by main (or a test) and outlives the server.
#pragma once

#include <stop_token>
#include <string>

#include "server/engine_port.h"
#include "server/gate.h"
#include "server/options.h"
#include "server/router.h"
#include "server/shape_service.h"

namespace spherematch {

struct ServerContext {
  const ServerOptions& options;
  const std::string version;
  const EnginePort& engine;
  ShapeService& shapes;
  Gate& matches;         ///< matches being computed
  std::stop_token stop;  ///< requested when the server stops
};

void add_shape_routes(Router& router, const ServerContext& context);
void add_match_routes(Router& router, const ServerContext& context);
void add_system_routes(Router& router, const ServerContext& context);

}  // namespace spherematch
