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

/// Flags of the subcommands that match.
struct MatchingOptions : CommonOptions {
  std::string method = "default";
  std::string refine = "default";
  std::string orientation = "preserve";
  int candidate = 0;
};

struct MatchOptions : MatchingOptions {
  std::string source;
  std::string target;
  std::string output;               ///< empty: only print
  std::vector<std::string> fields;  ///< of "confidence" and "distortion": what the output has beside the map
  std::vector<Hint> hints;
};

struct EvaluateOptions : MatchingOptions {
  std::string source;
  std::string target;
  std::string map;                     ///< empty: the two are matched
  std::string reverse;                 ///< empty: not given
  std::string truth;                   ///< empty: the landmarks, or else the identity
  std::vector<std::string> landmarks;  ///< two files, or none
  std::string mirrored;                ///< empty: not asked for
  std::string points;                  ///< empty: everywhere
  bool biharmonic = false;
  std::string json;   ///< "-" for standard output, empty for none
  std::string curve;  ///< empty for none
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

// For those that match (match_command.cpp).

void add_matching_options(CLI::App& command, MatchingOptions& options);
/// For those whose orientation is not given.
void add_orientation_option(CLI::App& command, MatchingOptions& options);
/// Of words that the options above have accepted.
[[nodiscard]] MatchParameters match_parameters(const MatchingOptions& options);

// For all (main.cpp).

void add_common_options(CLI::App& command, CommonOptions& options);
/// Prints what went wrong to standard error, after `subject` and a colon where it is not empty, and returns the ExitCode.
int report_current_exception(const std::string& subject);
/// One line per stage: name and seconds.
void print_seconds(const StageSeconds& seconds);

}  // namespace spherematch
