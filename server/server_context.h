// What the routes share. Owned by main (or a test) and outlives the server.
#pragma once

#include <stop_token>
#include <string>

#include "server/engine_port.h"
#include "server/gate.h"
#include "server/match_jobs.h"
#include "server/match_service.h"
#include "server/options.h"
#include "server/router.h"
#include "server/shape_service.h"
#include "storage/job_store.h"

namespace spherematch {

struct ServerContext {
  const ServerOptions& options;
  const std::string version;
  const EnginePort& engine;
  ShapeService& shapes;
  Gate& matches;  ///< matches being computed
  MatchService& match_service;
  MatchJobs& match_jobs;
  JobStore& jobs;
  std::stop_token stop;  ///< requested when the server stops
};

void add_shape_routes(Router& router, const ServerContext& context);
void add_derived_routes(Router& router, const ServerContext& context);
void add_thumbnail_routes(Router& router, const ServerContext& context);
void add_docs_routes(Router& router);
void add_job_routes(Router& router, const ServerContext& context);
void add_match_routes(Router& router, const ServerContext& context);
void add_match_post_routes(Router& router, const ServerContext& context);
void add_page_routes(Router& router);
void add_evaluation_routes(Router& router, const ServerContext& context);
void add_transfer_routes(Router& router, const ServerContext& context);
void add_scene_routes(Router& router, const ServerContext& context);
void add_system_routes(Router& router, const ServerContext& context);

}  // namespace spherematch
