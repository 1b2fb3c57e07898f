// spherematch-experiments: repeats the paper's measurements of its maps, and shows what each part of a match contributes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <thread>

#include "bench/experiments/experiments.h"
#include "bench/experiments/variants.h"

namespace spherematch::bench {

namespace {

struct Options {
  ExperimentSettings settings;
  AblationSettings ablation;
  PairListSettings hints;
  std::vector<int> steps{0, 5, 10, 20, 30, 50, 75, 100};
};

void describe(CLI::App& command, ExperimentSettings& settings, const char* places) {
  std::string names;
  for (const Variant& variant : variants()) names += (names.empty() ? "" : ", ") + variant.name;
  command.add_option("PLACE", settings.places, places)->required();
  command.add_option("--variants", settings.variants, "Some of " + names + ", separated by commas")->delimiter(',')->capture_default_str();
  command.add_flag("--paper-preparation", settings.paper_preparation, "Prepare the shapes with the paper's parameters too");
  command.add_option("--threads", settings.threads, "Threads to compute with")->check(CLI::Range(1, 256))->capture_default_str();
  command.add_option("--out", settings.out, "Folder for the results; made where missing")->capture_default_str();
}

void describe(CLI::App& command, PairListSettings& settings) {
  command.add_option("PAIRS", settings.pairs, "List of pairs, of the form of samples/pairs.json")->capture_default_str();
  command.add_option("--data", settings.data, "Folder with a folder of meshes and landmark lists for each set")->capture_default_str();
  command.add_option("--store", settings.store, "Store of prepared shapes; made where missing")->capture_default_str();
  command.add_option("--json", settings.json, "File for the results");
  command.add_option("--most-pairs", settings.most_pairs, "The first ones of each set; 0 for all")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--threads", settings.threads, "Threads to compute with")->check(CLI::Range(1, 256))->capture_default_str();
}

int main_of(int argc, const char* const* argv) {
  CLI::App app("Repeats the measurements of section 5 of the paper on given shapes, and others.", "spherematch-experiments");
  app.require_subcommand(1);
  Options options;
  ExperimentSettings& settings = options.settings;
  settings.threads = options.ablation.threads = options.hints.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  CLI::App& correspondences =
      *app.add_subcommand("correspondences", "Figure 6, left: distances to the truth over all pairs within a class");
  CLI::App& symmetry = *app.add_subcommand("symmetry", "Figure 6, right: each shape against its mirror image");
  CLI::App& authalic = *app.add_subcommand("authalic", "The inset of section 5.1: D(S, T) against the number of authalic steps");
  CLI::App& ablation = *app.add_subcommand("ablation", "What each part of a match contributes: without it, errors and times");
  CLI::App& hints = *app.add_subcommand("hints", "What hints do for a match: errors with some, and with wrong ones among them");
  describe(ablation, options.ablation);
  ablation.add_option("--runs", options.ablation.runs, "Of each match, of which the median time is taken")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  ablation.add_flag("--paper", options.ablation.paper, "Also the paper's method, which takes its time");
  describe(hints, options.hints);
  for (CLI::App* command : {&correspondences, &symmetry}) {
    describe(*command, settings, "Folders of OFF files, or files");
    command->add_flag("--whole-folders", settings.whole_folders, "A folder is a class, whatever the names of its files");
  }
  correspondences.add_option("--most-pairs", settings.most_pairs, "Of each class, evenly taken; 0 for all")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  describe(authalic, settings, "Two meshes that share their vertex numbering");
  authalic.add_option("--steps", options.steps, "Numbers of steps, separated by commas")
      ->delimiter(',')
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (ablation.parsed()) run_ablation(options.ablation);
  if (hints.parsed()) run_hints(options.hints);
  if (ablation.parsed() || hints.parsed()) return 0;
  std::filesystem::create_directories(settings.out);
  if (correspondences.parsed()) run_correspondences(settings);
  if (symmetry.parsed()) run_symmetry(settings);
  if (authalic.parsed()) run_authalic(settings, options.steps);
  return 0;
}

}  // namespace

}  // namespace spherematch::bench

int main(int argc, char** argv) {
  try {
    return spherematch::bench::main_of(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "spherematch-experiments: %s\n", error.what());
    return 1;
  }
}
