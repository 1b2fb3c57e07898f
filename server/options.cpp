#include "server/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <iostream>
#include <thread>

#include "server/config_file.h"

namespace spherematch {

namespace {

/// Every flag has an environment variable of the same name and shows its default.
template <typename Value>
CLI::Option* add_flag(CLI::App& app, const std::string& name, Value& value, const std::string& description) {
  return app.add_option("--" + name, value, description)->envname(variable_of(name))->capture_default_str();
}

void describe(CLI::App& app, ServerOptions& o, std::string& log_format) {
  add_flag(app, "host", o.host, "Address to listen on");
  add_flag(app, "port", o.port, "Port to listen on; 0 takes a free one")->check(CLI::Range(0, 65535));
  add_flag(app, "store", o.store, "SQLite file that keeps the shapes; made where missing");
  app.add_flag("--insecure", o.insecure, "Allow an address that other machines can reach without --keys")->envname(variable_of("insecure"));
  add_flag(app, "keys", o.keys, "File of API keys (see spherematch-server keys --help); without one everybody may do everything")
      ->type_name("FILE");
  add_flag(app, "workers", o.workers, "Shapes prepared at once")->check(CLI::Range(1, 64));
  add_flag(app, "threads", o.threads, "Threads of one preparation or one match")->check(CLI::Range(1, 256));
  add_flag(app, "max-body-mib", o.max_body_mib, "Largest upload in MiB")->check(CLI::Range(1, 900));
  add_flag(app, "max-vertices", o.max_vertices, "Most vertices of an uploaded mesh")->check(CLI::Range(4, 10'000'000));
  add_flag(app, "max-queued-jobs", o.max_queued_jobs, "Shapes that may wait for their preparation")->check(CLI::Range(1, 100'000));
  add_flag(app, "concurrent-matches", o.concurrent_matches, "Matches computed at once")->check(CLI::Range(1, 16));
  add_flag(app, "waiting-matches", o.waiting_matches, "Matches that may wait for their turn; further ones get 503")
      ->check(CLI::Range(0, 16));
  add_flag(app, "concurrent-uploads", o.concurrent_uploads, "Uploads read at once")->check(CLI::Range(1, 8));
  add_flag(app, "shape-cache-mib", o.shape_cache_mib, "Memory for prepared shapes in MiB")->check(CLI::Range(0, 1'000'000));
  add_flag(app, "match-cache-mib", o.match_cache_mib, "Memory for results of matches in MiB")->check(CLI::Range(0, 1'000'000));
  add_flag(app, "match-store-mib", o.match_store_mib, "Space in the store for results of matches in MiB")->check(CLI::Range(0, 1'000'000));
  add_flag(app, "min-free-mib", o.min_free_mib, "Free space on the store's disk below which /readyz fails, in MiB")
      ->check(CLI::Range(0, 100'000'000));
  add_flag(app, "stall-seconds", o.stall_seconds, "Silence of a preparation or a match after which /readyz fails")
      ->check(CLI::Range(1, 1'000'000));
  add_flag(app, "log-level", o.log_level, "Least level logged to standard error")
      ->check(CLI::IsMember({"debug", "info", "warn", "error", "off"}));
  add_flag(app, "log-format", log_format, "How a line of the log is written")->check(CLI::IsMember({"text", "json"}));
  add_config_file(app);
}

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv, const std::string& version) {
  ParsedOptions parsed;
  ServerOptions& options = parsed.options;
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  options.threads = cores;
  options.concurrent_matches = std::min(cores, 16);

  CLI::App app("Dense correspondence between genus-zero surfaces over HTTP. GET / names what the server offers.", "spherematch-server");
  app.footer("spherematch-server keys --help: how to make keys. A flag stands before its variable, that before the file of --config.");
  app.set_version_flag("--version", version);
  std::string log_format = "text";
  app.add_flag("--check", parsed.check,
               "Start nothing: ask the server that runs on --port for /readyz, print the answer, and end with 0 if it is ready")
      ->configurable(false);
  describe(app, options, log_format);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    parsed.exit_code = code == 0 ? 0 : 2;
    return parsed;
  }
  options.log_format = log_format == "json" ? LogFormat::json : LogFormat::text;
  if (!parsed.check && options.keys.empty() && !options.insecure && !is_loopback(options.host)) {
    std::cerr << "spherematch-server: --host " << options.host
              << " lets other machines in, and everybody may do everything; give --keys FILE, or --insecure if that is meant\n";
    parsed.exit_code = 2;
  }
  return parsed;
}

bool is_loopback(const std::string& host) {
  if (host == "localhost" || host == "::1") return true;
  // 127.0.0.0/8, fully written out: a name such as 127.example.org is not one.
  int parts = 0;
  const char* at = host.data();
  const char* const end = host.data() + host.size();
  while (true) {
    int value = -1;
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error != std::errc() || value < 0 || value > 255 || (parts == 0 && value != 127)) return false;
    ++parts;
    if (stop == end) return parts == 4;
    if (*stop != '.') return false;
    at = stop + 1;
  }
}

}  // namespace spherematch
