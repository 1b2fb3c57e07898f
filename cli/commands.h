// The subcommands. Each adds its flags to the parser, and runs after a successful parse.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/preparation.h"
#include "engine/data/parameters.h"

namespace CLI {
class App;
}

namespace spherematch {

/// Of "fill" or "none".
[[nodiscard]] inline RepairMode repair_mode(const std::string& name) { return name == "none" ? RepairMode::none : RepairMode::fill; }

/// Flags of the subcommands that use the store.
struct CommonOptions {
  std::string store = "data/spherematch.db";
  std::string repair = "fill";
  std::int32_t simplify = 0;
  int threads = 0;  ///< 0 until add_common_options(): then the number of cores

  [[nodiscard]] PreparationOptions preparation() const {
    return {.read = {.repair = repair_mode(repair), .simplify = simplify}, .threads = threads};
  }
};

struct PrepareOptions : CommonOptions {
  std::vector<std::string> meshes;
};

struct MatchOptions : CommonOptions {
  std::string source;
  std::string target;
  std::string output;  ///< empty: only print
  std::string method = "default";
  std::string orientation = "preserve";
  std::vector<Hint> hints;
  int candidate = 0;
};

struct EvaluateOptions {
  std::string source;
  std::string target;
  std::string map;
  std::vector<std::string> landmarks;  ///< two files, or none: the identity is the truth
  std::string mirrored;                ///< empty: not asked for
  std::string repair = "fill";
};

void add_prepare_options(CLI::App& command, PrepareOptions& options);
void add_match_options(CLI::App& command, MatchOptions& options);
/// `options.source` becomes the one mesh.
void add_symmetry_options(CLI::App& command, MatchOptions& options);
void add_evaluate_options(CLI::App& command, EvaluateOptions& options);

/// Returns an ExitCode. A mesh that fails does not keep the others from being prepared.
int run_prepare(const PrepareOptions& options);
int run_match(const MatchOptions& options);
/// The match of the source with its own mirror image.
int run_symmetry(MatchOptions options);
int run_evaluate(const EvaluateOptions& options);

// For all (main.cpp).

void add_common_options(CLI::App& command, CommonOptions& options);
/// Prints what went wrong to standard error, after `subject` and a colon where it is not empty, and returns the ExitCode.
int report_current_exception(const std::string& subject);
/// One line per stage: name and seconds.
void print_seconds(const StageSeconds& seconds);

}  // namespace spherematch
