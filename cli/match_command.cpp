#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/files.h"
#include "cli/output_format.h"
#include "engine/engine.h"
#include "engine/io/mesh_reader.h"

namespace spherematch {

namespace {

const std::map<std::string, Orientation> orientations{
    {"preserve", Orientation::preserve}, {"reverse", Orientation::reverse}, {"any", Orientation::any}};

Preparation prepare_side(ShapeStore& store, const std::string& mesh, const MatchOptions& options) {
  Preparation preparation = prepare_file(store, mesh, options.preparation());
  std::printf("%s: %d vertices%s\n", mesh.c_str(), preparation.shape->surface.uploaded_vertices(),
              preparation.was_stored ? ", already in the store" : "");
  if (!preparation.was_stored) print_seconds(preparation.shape->seconds);
  return preparation;
}

MatchParameters parameters_of(const MatchOptions& options) {
  MatchParameters parameters = match_parameters(options);
  parameters.hints = options.hints;
  return parameters;
}

/// With the error in the parser's own terms.
std::vector<Hint> hints_of(const std::string& text) {
  try {
    return parse_hints(text);
  } catch (const EngineError& error) {
    throw CLI::ValidationError(error.what());
  }
}

void print_result(const MatchResult& result) {
  std::printf("match%s\n", result.reversed ? " of the source's mirror image" : "");
  print_seconds(result.seconds);
  int number = 0;
  for (const CandidateSummary& candidate : result.candidates) {
    std::printf("  candidate %d: correlation %.4f, score %.5g%s\n", ++number, candidate.correlation, candidate.score,
                candidate.chosen ? ", chosen" : "");
  }
  for (const auto& [name, value] : result.quality) std::printf("  quality: %s %.5g\n", name.c_str(), value);
}

/// As far as it is asked for; the rest stays empty.
VertexQuality quality_of(const Correspondence& map, const MatchOptions& options, const MatchShape& source, const MatchShape& target) {
  if (options.fields.empty()) return {};
  const auto asked = [&options](const char* name) {
    return std::find(options.fields.begin(), options.fields.end(), name) != options.fields.end();
  };
  VertexQuality quality = vertex_quality(source, target, map);
  if (!asked("confidence")) quality.confidence.clear();
  if (!asked("distortion")) quality.distortion.clear();
  return quality;
}

void write_map(const ShapeStore& store, const std::string& source_id, const MatchOptions& options, const Correspondence& map,
               const MatchShape& source, const MatchShape& target) {
  const MapFormat format = output_format_of(options.output).value();
  PolygonMesh source_mesh;
  if (needs_source_mesh(format)) source_mesh = read_mesh(store.load_upload(source_id), options.source, ReadLimits::none());
  write_file(options.output,
             encode_map(format, map, source.surface(), target.surface(), std::move(source_mesh), quality_of(map, options, source, target)));
}

/// -o, and what depends on its format.
void add_output_options(CLI::App& command, MatchOptions& options) {
  CLI::Option* output =
      command.add_option("-o,--output", options.output, "Where to write the map or its picture: " + supported_extensions())
          ->check([](const std::string& file) {
            return output_format_of(file) ? std::string()
                                          : "'" + file + "' has no supported extension; supported are " + supported_extensions();
          });
  command
      .add_option("--fields", options.fields,
                  "What .npz and .ply shall have beside the map, for each vertex of the source: confidence,distortion or one of them")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"confidence", "distortion"}))
      ->needs(output);
  command.final_callback([&options] {
    if (!options.fields.empty() && !holds_quality(output_format_of(options.output).value())) {
      throw CLI::ValidationError("--fields", "'" + options.output + "' has no room for them; .npz and .ply have");
    }
  });
}

/// Those that do not depend on whether there are one or two meshes.
void add_shared_options(CLI::App& command, MatchOptions& options) {
  add_output_options(command, options);
  add_matching_options(command, options);
  command
      .add_option_function<std::string>(
          "--hints", [&options](const std::string& text) { options.hints = hints_of(text); },
          "Vertices that correspond, numbered from 0, as SOURCE:TARGET,SOURCE:TARGET,...")
      ->type_name("TEXT");
  add_common_options(command, options);
}

}  // namespace

MatchParameters match_parameters(const MatchingOptions& options) {
  MatchParameters parameters = options.method == "paper" ? MatchParameters::paper() : MatchParameters{};
  if (options.refine == "none") parameters.elastic_iterations = {};
  parameters.orientation = orientations.at(options.orientation);
  parameters.candidate = options.candidate;
  return parameters;
}

void add_matching_options(CLI::App& command, MatchingOptions& options) {
  command.add_option("--method", options.method, "Parameters of the match: the best measured ones, or the paper's")
      ->check(CLI::IsMember({"default", "paper"}))
      ->capture_default_str();
  command.add_option("--refine", options.refine, "The elastic flow after the optical flow: as the method has it, or none")
      ->check(CLI::IsMember({"default", "none"}))
      ->capture_default_str();
  command.add_option("--candidate", options.candidate, "Which map: 0 for that of the best rotation, 1 for the next best")
      ->check(CLI::Range(0, MatchParameters{}.max_candidates - 1))
      ->capture_default_str();
}

void add_orientation_option(CLI::App& command, MatchingOptions& options) {
  command
      .add_option("--orientation", options.orientation,
                  "Match the source as it is, its mirror image (left bone to right bone), or whichever scores better")
      ->check(CLI::IsMember({"preserve", "reverse", "any"}))
      ->capture_default_str();
}

void add_match_options(CLI::App& command, MatchOptions& options) {
  command.add_option("SRC", options.source, "Source mesh: the map has one entry for each of its vertices")->required();
  command.add_option("TGT", options.target, "Target mesh")->required();
  add_orientation_option(command, options);
  add_shared_options(command, options);
}

void add_symmetry_options(CLI::App& command, MatchOptions& options) {
  command.add_option("MESH", options.source, "Mesh: the map has one entry for each of its vertices, a place on the mesh itself")
      ->required();
  add_shared_options(command, options);
}

int run_match(const MatchOptions& options) {
  ShapeStore store(options.store);
  std::string subject = options.source;
  try {
    const Preparation source = prepare_side(store, options.source, options);
    subject = options.target;
    // One object where a mesh is matched with itself: the engine then knows that it looks for a symmetry.
    const Preparation target = options.target == options.source ? source : prepare_side(store, options.target, options);
    subject = "match";
    const MatchShape source_side(source.shape), target_side(target.shape);
    const MatchResult result = match(source_side, target_side, parameters_of(options), {}, options.threads);
    print_result(result);
    if (!options.output.empty()) {
      write_map(store, source.id, options, result.map, source_side, target_side);
      std::printf("wrote %s\n", options.output.c_str());
    }
    return exit_success;
  } catch (...) {
    return report_current_exception(subject);
  }
}

int run_symmetry(MatchOptions options) {
  options.target = options.source;
  options.orientation = "reverse";
  return run_match(options);
}

}  // namespace spherematch
