// The server: options, store, engine, routes, signals.
#include <malloc.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string_view>
#include <thread>

#include "server/check_command.h"
#include "server/event_log.h"
#include "server/http_server.h"
#include "server/keys_command.h"
#include "server/operations.h"
#include "server/options.h"
#include "server/preparation_process.h"
#include "server/real_engine.h"
#include "server/server_context.h"
#include "server/shape_service.h"
#include "storage/shape_store.h"

namespace spherematch {

namespace {

constexpr std::chrono::milliseconds stop_deadline{2000};

/// One half for the shapes, the other for what matches add to them.
std::size_t half_of_shape_cache(const ServerOptions& options) { return static_cast<std::size_t>(options.shape_cache_mib) << 19; }

ShapeServiceSettings shape_settings(const ServerOptions& options, Metrics& metrics) {
  return {.workers = static_cast<std::size_t>(options.workers),
          .max_queued = static_cast<std::size_t>(options.max_queued_jobs),
          .cache_bytes = half_of_shape_cache(options),
          .read_limits = {.max_vertices = options.max_vertices},
          .on_stage = [&metrics](std::string_view stage, double seconds) { metrics.stage_finished(stage, seconds); }};
}

MatchServiceSettings match_settings(const ServerOptions& options, Metrics& metrics) {
  return {.memory_bytes = static_cast<std::size_t>(options.match_cache_mib) << 20,
          .observe = [&metrics](MatchSource source, double seconds) { metrics.match_finished(to_string(source), seconds); }};
}

MatchJobsSettings job_settings(const ServerOptions& options) { return {.workers = static_cast<std::size_t>(options.concurrent_matches)}; }

constexpr std::size_t waiting_uploads = 16;

/// One thread for everybody who may legitimately wait, send or compute, and a dozen more, so that short requests always find one.
HttpServerSettings http_settings(const ServerOptions& options) {
  HttpServerSettings settings;
  const int heavy = options.concurrent_matches + options.waiting_matches + options.concurrent_uploads;
  settings.threads =
      static_cast<std::size_t>(heavy) + ShapeServiceSettings{}.max_long_polls + settings.receiving_uploads + waiting_uploads + 12;
  settings.max_body_bytes = options.max_body_bytes();
  settings.upload_memory = static_cast<std::size_t>(options.concurrent_uploads) * options.max_body_bytes();
  return settings;
}

/// What a large upload took goes back to the system with its end. Left alone, the allocator keeps it: after some hundred uploads on
/// as many threads several hundred megabytes.
void return_memory_early() {
  ::mallopt(M_MMAP_THRESHOLD, 4 << 20);  // also ends its growing with what is freed
  ::mallopt(M_TRIM_THRESHOLD, 16 << 20);
  ::mallopt(M_ARENA_MAX, 4);
}

/// A connection takes a descriptor, and the usual 1024 are fewer than the lobby, the queue and the threads hold together.
void raise_descriptor_limit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = std::max(limit.rlim_cur, std::min<rlim_t>(limit.rlim_max, 8192));
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

/// Blocks the signals in this thread and all that it starts; they are then taken by sigwait().
sigset_t block_stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

/// Ends the process when a stop takes too long. Nothing is lost: every change to the store is a transaction of its own.
void end_after_deadline(const std::stop_token& stopped_in_time) {
  const auto deadline = std::chrono::steady_clock::now() + stop_deadline;
  while (std::chrono::steady_clock::now() < deadline) {
    if (stopped_in_time.stop_requested()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  log_warning("stop_deadline_passed");
  std::_Exit(0);
}

int serve(const ServerOptions& options) {
  return_memory_early();
  raise_descriptor_limit();
  const sigset_t signals = block_stop_signals();
  Access access(options.keys.empty() ? std::nullopt : std::optional<std::filesystem::path>(options.keys));
  ShapeStore store(options.store);
  const RealEngine engine(options.threads, half_of_shape_cache(options));
  Operations operations(access, store, SPHEREMATCH_VERSION, engine.version());
  ShapeService shapes(store, engine, shape_settings(options, operations.metrics()));
  Gate matches("matches", static_cast<std::size_t>(options.concurrent_matches), static_cast<std::size_t>(options.waiting_matches));
  Gate uploads("uploads", static_cast<std::size_t>(options.concurrent_uploads), waiting_uploads);
  std::stop_source stop;
  MatchStore match_store(store, static_cast<std::size_t>(options.match_store_mib) << 20);
  MatchService match_service(shapes, match_store, engine, matches, stop.get_token(), match_settings(options, operations.metrics()));
  JobStore jobs(store);
  MatchJobs match_jobs(jobs, shapes, match_service, job_settings(options));
  const ServerContext context{options, SPHEREMATCH_VERSION, engine, shapes, matches, match_service, match_jobs, jobs, stop.get_token()};
  Router router;
  operations.add_to(router, context);
  add_system_routes(router, context);
  add_shape_routes(router, context);
  add_derived_routes(router, context);
  add_thumbnail_routes(router, context);
  add_match_routes(router, context);
  add_match_post_routes(router, context);
  add_evaluation_routes(router, context);
  add_transfer_routes(router, context);
  add_scene_routes(router, context);
  add_job_routes(router, context);
  add_page_routes(router);
  add_docs_routes(router);
  HttpServerSettings settings = http_settings(options);
  operations.add_to(settings);
  HttpServer server(router, uploads, settings);
  const int port = server.bind(options.host, options.port);

  const bool is_ipv6 = options.host.find(':') != std::string::npos;
  std::cout << "listening on http://" << (is_ipv6 ? "[" + options.host + "]" : options.host) << ":" << port << std::endl;
  log_info("started", {{"version", SPHEREMATCH_VERSION},
                       {"port", port},
                       {"store", options.store},
                       {"engine", engine.version()},
                       {"threads", options.threads}});
  std::jthread serving([&server] { server.run(); });

  int signal = 0;
  sigwait(&signals, &signal);
  log_info("stopping", {{"signal", signal}});
  std::jthread watchdog(end_after_deadline);
  stop.request_stop();
  matches.close();
  uploads.close();
  server.stop();
  match_jobs.stop();
  shapes.stop();
  serving.join();
  watchdog.request_stop();
  log_info("stopped");
  return 0;
}

}  // namespace

}  // namespace spherematch

int main(int argc, char** argv) {
  if (argc == 3 && argv[1] == std::string_view(spherematch::preparation_argument)) {
    return spherematch::prepare_for_server(STDIN_FILENO, std::max(1, std::atoi(argv[2])));
  }
  if (argc >= 2 && argv[1] == std::string_view(spherematch::keys_argument)) return spherematch::keys_command(argc - 1, argv + 1);
  const auto [options, check, exit_code] = spherematch::parse_options(argc, argv, SPHEREMATCH_VERSION);
  if (exit_code) return *exit_code;
  if (check) return spherematch::check_command(options.host, options.port);
  try {
    spherematch::set_up_log(options.log_level, options.log_format);
    return spherematch::serve(options);
  } catch (const std::exception& error) {
    std::cerr << "spherematch-server: " << error.what() << "\n";
    return 1;
  }
}
