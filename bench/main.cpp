// spherematch-bench: how long preparing and matching take, stage by stage and size by size.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bench/mesh_files.h"
#include "bench/pair_benchmark.h"
#include "bench/results_json.h"
#include "bench/table.h"

namespace spherematch::bench {

namespace {

constexpr int least_vertices = 100;
constexpr int most_vertices = 1'000'000;

struct Options {
  std::vector<std::int32_t> sizes{2000, 5000, 10000, 20000, 50000, 100000, 200000, 500000};
  std::vector<std::string> pair{"samples/hound/stand.off", "samples/hound/bow.off"};
  BenchmarkSettings settings;
  std::string json;
  std::string grow_from;
  std::string grow_to;
  std::int32_t grow_vertices = 0;
};

void write_file(const std::string& name, const std::string& text) {
  std::ofstream out(name, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(name + ": cannot be written");
}

/// The file is written after every size, so that what a long run has found is there when it is stopped.
void run(const Options& options) {
  std::vector<PairResult> results;
  for (const std::int32_t size : options.sizes) {
    results.push_back(run_pair(options.pair.front(), options.pair.back(), size, options.settings));
    std::puts(table_of(results.back()).c_str());
    std::fflush(stdout);
    if (!options.json.empty()) write_file(options.json, file_text(options.settings, results));
  }
}

void describe(CLI::App& app, Options& options) {
  const CLI::Range size(least_vertices, most_vertices);
  BenchmarkSettings& settings = options.settings;
  settings.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  app.add_option("--sizes", options.sizes, "Numbers of vertices, separated by commas")->delimiter(',')->check(size)->capture_default_str();
  app.add_option("--pair", options.pair, "Two mesh files; the first is the one whose preparation is measured")
      ->expected(2)
      ->capture_default_str();
  app.add_option("--runs", settings.runs, "Runs of which the median is taken")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--budget", settings.budget_seconds, "Seconds after which a size's preparation, or match, is not run again")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--threads", settings.threads, "Threads to compute with")->check(CLI::Range(1, 256))->capture_default_str();
  app.add_flag("--both", settings.both, "Match in both directions at once");
  app.add_option("--json", options.json, "File for the results, from which growth_curve.py draws");
  CLI::App& grow = *app.add_subcommand("grow", "Write a mesh with so many vertices as OFF, and measure nothing");
  grow.add_option("IN", options.grow_from, "Mesh file")->required();
  grow.add_option("OUT", options.grow_to, "OFF file to write")->required();
  grow.add_option("VERTICES", options.grow_vertices, "How many vertices it shall have")->required()->check(size);
}

int main_of(int argc, const char* const* argv) {
  CLI::App app("Measures the stages of preparing and matching on sample shapes of any size. Run it where samples/ is.",
               "spherematch-bench");
  Options options;
  describe(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (app.get_subcommands().empty()) {
    run(options);
  } else {
    write_file(options.grow_to, resized_off(options.grow_from, options.grow_vertices));
  }
  return 0;
}

}  // namespace

}  // namespace spherematch::bench

int main(int argc, char** argv) {
  try {
    return spherematch::bench::main_of(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "spherematch-bench: %s\n", error.what());
    return 1;
  }
}
