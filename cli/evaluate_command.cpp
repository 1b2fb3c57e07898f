#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/evaluation_json.h"
#include "cli/exit_code.h"
#include "cli/files.h"
#include "cli/progress_bar.h"
#include "cli/truth_files.h"
#include "engine/data/error.h"
#include "engine/engine.h"
#include "engine/io/curve_picture.h"
#include "engine/io/map_reader.h"

namespace spherematch {

namespace {

using ShapePointer = std::shared_ptr<const PreprocessedShape>;

/// The two shapes, as far as what is asked for needs them prepared, and the maps between them.
struct Pair {
  ShapePointer source;
  ShapePointer target;
  Correspondence map;
  std::optional<Correspondence> reverse;
};

/// With nothing but its surface where it need not be prepared; the store is opened where it must.
ShapePointer read_shape(std::optional<ShapeStore>& store, const std::string& file, bool prepared, const EvaluateOptions& options) {
  if (!prepared) {
    auto shape = std::make_shared<PreprocessedShape>();
    shape->surface = read_surface(read_file(file), file, {.repair = repair_mode(options.repair)});
    return shape;
  }
  if (!store) store.emplace(options.store);
  return prepare_file(*store, file, options.preparation()).shape;
}

Correspondence read_map(const std::string& file, std::int32_t source_vertices, const char* source) {
  Correspondence map = decode_npz(read_file(file));
  if (map.vertex.size() == static_cast<std::size_t>(source_vertices)) return map;
  throw EngineError(ErrorCode::invalid_parameter, file + " maps " + std::to_string(map.vertex.size()) + " vertices, the " + source +
                                                      " has " + std::to_string(source_vertices));
}

Progress shown_in(ProgressBar& bar) {
  return {.report = [&bar](std::string_view stage, double fraction) { bar.report(stage, fraction); }, .stop = {}};
}

/// `subject` is set to what is being read, for messages.
Pair read_pair(const EvaluateOptions& options, std::string& subject) {
  std::optional<ShapeStore> store;
  const bool matches = options.map.empty();
  Pair pair;
  subject = options.source;
  pair.source = read_shape(store, options.source, matches || (options.biharmonic && !options.reverse.empty()), options);
  subject = options.target;
  // One object where a mesh is matched with itself: the engine then knows that it looks for a symmetry.
  pair.target =
      matches && options.target == options.source ? pair.source : read_shape(store, options.target, matches || options.biharmonic, options);
  if (matches) {
    subject = "match";
    MatchParameters parameters = match_parameters(options);
    parameters.both = true;
    ProgressBar bar(std::cerr, ::isatty(STDERR_FILENO) != 0);
    MatchResult result = match(*pair.source, *pair.target, parameters, shown_in(bar), options.threads);
    pair.map = std::move(result.map);
    pair.reverse = std::move(result.reverse);
    return pair;
  }
  subject = options.map;
  pair.map = read_map(options.map, pair.source->surface.uploaded_vertices(), "source");
  subject = options.reverse;
  if (!options.reverse.empty()) pair.reverse = read_map(options.reverse, pair.target->surface.uploaded_vertices(), "target");
  return pair;
}

void print(const char* title, const std::optional<MapError>& error, const char* unit, const char* points) {
  if (!error) return;
  std::printf("%s: mean %.2f, median %.2f, 95%% below %.2f, largest %.2f (%s), %d %s\n", title, 100 * error->mean, 100 * error->median,
              100 * error->p95, 100 * error->max, unit, error->scored, points);
  if (error->area_mean) std::printf("  mean by area %.2f\n", 100 * *error->area_mean);
  if (error->unscored > 0) std::printf("  %d %s at dropped vertices were left out\n", error->unscored, points);
}

void print(const Evaluation& evaluation) {
  constexpr const char* of_target = "percent of the square root of the target's area";
  constexpr const char* of_source = "percent of the square root of the source's area";
  print("error", evaluation.geodesic, of_target, "landmarks");
  print("against the mirrored truth", evaluation.mirrored, of_target, "landmarks");
  if (evaluation.flipped) std::printf("flipped: %s\n", *evaluation.flipped ? "yes" : "no");
  print("biharmonic", evaluation.biharmonic, "times 100, at unit area", "landmarks");
  if (evaluation.symmetric_integral) std::printf("D(S, T): %.4f\n", *evaluation.symmetric_integral);
  const auto& [edges, torn, distortion, median, p95, max, dirichlet, turned] = evaluation.continuity;
  std::printf("edges: stretched by %.2f in the median, 95%% below %.2f, largest %.2f, distorted by %.2f; %d of %d torn\n", median, p95, max,
              distortion, torn, edges);
  std::printf("faces: Dirichlet energy %.2f, %.2f%% of the area turned over\n", dirichlet, 100 * turned);
  std::printf("coverage: %.2f%% of the target's area, %.2f%% of its vertices\n", 100 * evaluation.coverage.area,
              100 * evaluation.coverage.vertices);
  print("there and back", evaluation.bijectivity, of_source, "vertices");
  print("there and back, biharmonic", evaluation.bijectivity_biharmonic, "times 100, at unit area", "vertices");
}

void write_json(const EvaluateOptions& options, const Evaluation& evaluation) {
  const std::string text = evaluation_json(evaluation, options.source, options.target);
  if (options.json == "-") {
    std::fputs(text.c_str(), stdout);
  } else {
    write_file(options.json, text);
  }
}

}  // namespace

void add_evaluate_options(CLI::App& command, EvaluateOptions& options) {
  command.add_option("SRC", options.source, "Source mesh")->required();
  command.add_option("TGT", options.target, "Target mesh")->required();
  CLI::Option* map =
      command.add_option("MAP", options.map, "The map to measure, as match writes it to an .npz file; without it the two are matched");
  command.add_option("--reverse", options.reverse, "The map from TGT to SRC, for how far the two are from each other's inverses")
      ->needs(map);
  CLI::Option* landmarks = command
                               .add_option("--landmarks", options.landmarks,
                                           "Two lists of vertex numbers, from 1: row i of the first, on SRC, belongs to row i of the "
                                           "second, on TGT. Without it the vertices of equal number belong together")
                               ->expected(2);
  command
      .add_option("--truth", options.truth,
                  "'identity', 'none', or a file with the number of a vertex of TGT, from 0, for each vertex of SRC in turn, -1 for none")
      ->excludes(landmarks);
  command
      .add_option("--mirrored", options.mirrored,
                  "A third list: the left-right mirrored places on TGT. A map that is nearer to it is called flipped")
      ->needs(landmarks);
  command.add_option("--points", options.points, "A list of vertex numbers of SRC, from 1: errors are measured there alone");
  command.add_flag(
      "--biharmonic", options.biharmonic,
      "Biharmonic distances as well, by the eigenbasis of TGT, which is prepared where the store lacks it. Implied without MAP");
  command.add_option("--json", options.json, "File for all figures as JSON; - for standard output in place of the text");
  command.add_option("--curve", options.curve, "File for a picture of the cumulative error curves: .svg")
      ->check([](const std::string& file) { return file.ends_with(".svg") ? std::string() : "'" + file + "' does not end in .svg"; });
  add_matching_options(command, options);
  add_orientation_option(command, options);
  add_common_options(command, options);
}

int run_evaluate(const EvaluateOptions& options) {
  std::string subject;
  try {
    const Pair pair = read_pair(options, subject);
    subject = "evaluate";
    const GroundTruth truth =
        read_truth({.truth = options.truth, .landmarks = options.landmarks, .mirrored = options.mirrored, .points = options.points},
                   pair.source->surface.uploaded_vertices(), pair.target->surface.uploaded_vertices());
    std::optional<Evaluation> evaluation;
    {
      ProgressBar bar(std::cerr, ::isatty(STDERR_FILENO) != 0);
      evaluation =
          evaluate(*pair.source, *pair.target, pair.map, pair.reverse ? &*pair.reverse : nullptr, truth, shown_in(bar), options.threads);
    }
    if (options.json != "-") print(*evaluation);
    if (!options.json.empty()) write_json(options, *evaluation);
    if (!options.curve.empty()) write_file(options.curve, encode_svg(*evaluation, options.source + " to " + options.target));
    return exit_success;
  } catch (...) {
    return report_current_exception(subject);
  }
}

}  // namespace spherematch
