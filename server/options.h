// What the command line, the environment and a configuration file decide.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "server/event_log.h"

namespace spherematch {

/// The longest `wait` of any request.
inline constexpr double max_wait_seconds = 60;

struct ServerOptions {
  std::string host = "127.0.0.1";
  int port = 8080;
  std::string store = "data/spherematch.db";
  bool insecure = false;
  std::string keys;  ///< file of API keys; empty for none
  int workers = 1;
  int threads = 0;  ///< 0 until parsed: then the number of cores
  std::int64_t max_body_mib = 64;
  std::int64_t max_vertices = 300'000;
  int max_queued_jobs = 1000;
  int concurrent_matches = 0;  ///< 0 until parsed: then the number of cores
  int waiting_matches = 16;
  int concurrent_uploads = 4;
  int shape_cache_mib = 256;
  int match_cache_mib = 64;
  int match_store_mib = 1024;
  int min_free_mib = 256;
  int stall_seconds = 600;
  std::string log_level = "info";
  LogFormat log_format = LogFormat::text;

  [[nodiscard]] std::size_t max_body_bytes() const { return static_cast<std::size_t>(max_body_mib) << 20; }
};

struct ParsedOptions {
  ServerOptions options;
  bool check = false;            ///< only ask a server that runs with these options whether it is ready
  std::optional<int> exit_code;  ///< engaged when the program should end here: after --help, or on a bad flag
};

/// A flag stands before its environment variable, that before the configuration file (--config), and that before the default.
/// Prints help and errors itself.
[[nodiscard]] ParsedOptions parse_options(int argc, const char* const* argv, const std::string& version);

/// Whether only programs on this machine can reach a server on that host.
[[nodiscard]] bool is_loopback(const std::string& host);

}  // namespace spherematch
