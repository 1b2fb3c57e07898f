#include "server/operations.h"

#include <chrono>
#include <filesystem>

#include "server/routes_operations.h"

namespace spherematch {

namespace {

std::string timed_write(ShapeStore& store) {
  const auto started = std::chrono::steady_clock::now();
  store.check_writable();
  const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - started);
  return "a write took " + std::to_string(took.count()) + " ms";
}

/// The store's file with what SQLite keeps beside it.
std::uintmax_t store_bytes(const std::string& store) {
  std::uintmax_t sum = 0;
  for (const char* suffix : {"", "-wal", "-shm"}) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(store + suffix, error);
    if (!error) sum += size;
  }
  return sum;
}

MetricsSnapshot snapshot_of(const ServerContext& context) {
  const JobRunner::Counts jobs = context.shapes.job_counts();
  const MatchJobs::Counts match_jobs = context.match_jobs.counts();
  const Gate::Counts matches = context.matches.counts();
  return {.jobs = {{"preprocess", "queued", jobs.queued},
                   {"preprocess", "processing", jobs.running},
                   {"match", "queued", match_jobs.queued},
                   {"match", "processing", match_jobs.processing}},
          .matches = {{"running", matches.inside}, {"waiting", matches.waiting}},
          .cache_bytes = {{"shapes", context.shapes.cache_bytes()},
                          {"matches", context.match_service.memory_bytes()},
                          {"stored_matches", context.match_service.store_bytes()}},
          .store_bytes = store_bytes(context.options.store)};
}

void add_checks(Readiness& readiness, const ServerContext& context, BackgroundCheck& writes) {
  const ServerOptions& options = context.options;
  const std::chrono::seconds stall(options.stall_seconds);
  readiness.add("store", [&writes] { return writes.answer(); });
  readiness.add("disk", [&options] { return check_free_space(options.store, static_cast<std::uintmax_t>(options.min_free_mib) << 20); });
  readiness.add("preparations", [&context, stall] { return check_progress("preparations", context.shapes.job_counts().silence, stall); });
  readiness.add("matches", [&context, stall] { return check_progress("matches", context.matches.counts().longest, stall); });
  readiness.add("stopping", [&context] {
    const bool stops = context.stop.stop_requested();
    return BackgroundCheck::Answer{.good = !stops, .detail = stops ? "the server is stopping" : "the server takes requests"};
  });
}

}  // namespace

Operations::Operations(Access& access, ShapeStore& store, const std::string& version, const std::string& engine)
    : access_(access), metrics_(version, engine), writes_([&store] { return timed_write(store); }, {}) {}

void Operations::add_to(Router& router, const ServerContext& context) {
  router.set_guard([this](const HttpRequest& request, std::string_view pattern) { access_.check(request, pattern); });
  add_metrics_route(router, metrics_, [&context] { return snapshot_of(context); });
  add_checks(readiness_, context, writes_);
  add_readiness_route(router, readiness_);
}

void Operations::add_to(HttpServerSettings& settings) {
  settings.caller = [this](std::string_view authorization, std::string_view api_key) { return access_.caller(authorization, api_key); };
  settings.on_request = [this](const FinishedRequest& request) {
    metrics_.request_finished(request.method, request.route, request.status, request.seconds);
  };
}

}  // namespace spherematch
