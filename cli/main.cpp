// The `spherematch` command: engine and store without a server.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <limits>
#include <thread>

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "engine/data/error.h"
#include "storage/error.h"

namespace spherematch {

namespace {

constexpr const char* footer =
    "Exit codes: 0 success, 1 unforeseen failure, 2 wrong usage, 3 a mesh that cannot be used,\n"
    "4 a file or the store that cannot be read or written.";

int fail(const std::string& subject, const char* what, int code) {
  std::fflush(stdout);
  std::cerr << "spherematch: " << (subject.empty() ? "" : subject + ": ") << what << "\n";
  return code;
}

int run(int argc, const char* const* argv) {
  CLI::App app("Dense correspondence between genus-zero surfaces, without a server.", "spherematch");
  app.set_version_flag("--version", std::string(SPHEREMATCH_VERSION));
  app.require_subcommand(1);
  app.footer(footer);

  PrepareOptions prepare_options;
  CLI::App& prepare = *app.add_subcommand("prepare", "Preprocess meshes into the store, where it lacks them");
  add_prepare_options(prepare, prepare_options);
  MatchOptions match_options;
  CLI::App& match = *app.add_subcommand("match", "Map the vertices of one mesh to another");
  add_match_options(match, match_options);
  MatchOptions symmetry_options;
  CLI::App& symmetry =
      *app.add_subcommand("symmetry", "Map the vertices of a mesh to their mirror images, left to right, on the same mesh");
  add_symmetry_options(symmetry, symmetry_options);
  EvaluateOptions evaluate_options;
  CLI::App& evaluate = *app.add_subcommand("evaluate", "Measure a map: errors against ground truth, continuity, coverage");
  add_evaluate_options(evaluate, evaluate_options);
  for (CLI::App* command : {&prepare, &match, &symmetry, &evaluate}) command->footer(footer);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_success : exit_usage;
  }
  if (prepare.parsed()) return run_prepare(prepare_options);
  if (symmetry.parsed()) return run_symmetry(symmetry_options);
  return match.parsed() ? run_match(match_options) : run_evaluate(evaluate_options);
}

}  // namespace

void add_common_options(CLI::App& command, CommonOptions& options) {
  options.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  command.add_option("--store", options.store, "SQLite file that keeps the shapes; made where missing")->capture_default_str();
  command.add_option("--repair", options.repair, "Mend what can be mended, or refuse it")
      ->check(CLI::IsMember({"fill", "none"}))
      ->capture_default_str();
  command
      .add_option("--simplify", options.simplify,
                  "Prepare a decimated copy of about this many vertices where a mesh has more; maps still speak of the mesh itself")
      ->check(CLI::Range(ReadOptions::least_simplify, std::numeric_limits<std::int32_t>::max()));
  command.add_option("--threads", options.threads, "Threads to compute with")->check(CLI::Range(1, 256))->capture_default_str();
}

int report_current_exception(const std::string& subject) {
  try {
    throw;
  } catch (const EngineError& error) {
    return fail(subject, error.what(), exit_mesh);
  } catch (const FileError& error) {
    return fail({}, error.what(), exit_file);  // names the file itself
  } catch (const StorageError& error) {
    return fail(subject, error.what(), exit_file);
  } catch (const std::exception& error) {
    return fail(subject, error.what(), exit_failure);
  }
}

void print_seconds(const StageSeconds& seconds) {
  for (const auto& [stage, value] : seconds) std::printf("  %-16s %8.3f s\n", stage.c_str(), value);
}

}  // namespace spherematch

int main(int argc, char** argv) {
  try {
    return spherematch::run(argc, argv);
  } catch (...) {
    return spherematch::report_current_exception({});
  }
}
