#include <CLI/CLI.hpp>
#include <cstdio>
#include <string_view>
#include <vector>

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/files.h"
#include "engine/data/error.h"
#include "engine/engine.h"
#include "engine/io/map_reader.h"

namespace spherematch {

namespace {

std::vector<std::int32_t> read_landmark_file(const std::string& file) {
  const std::vector<std::byte> bytes = read_file(file);
  return read_landmarks({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// Pairs row i of one list with row i of the other.
std::vector<Landmark> pair_up(const std::vector<std::int32_t>& source, const std::vector<std::int32_t>& target) {
  if (source.size() != target.size()) {
    throw EngineError(ErrorCode::invalid_parameter,
                      "the landmark lists have " + std::to_string(source.size()) + " and " + std::to_string(target.size()) + " entries");
  }
  std::vector<Landmark> landmarks;
  for (std::size_t i = 0; i < source.size(); ++i) landmarks.push_back({source[i], target[i]});
  return landmarks;
}

std::vector<Landmark> identity(std::int32_t source_vertices, std::int32_t target_vertices) {
  if (source_vertices != target_vertices) {
    throw EngineError(ErrorCode::invalid_parameter, "the meshes have " + std::to_string(source_vertices) + " and " +
                                                        std::to_string(target_vertices) + " vertices; the truth needs --landmarks");
  }
  std::vector<Landmark> landmarks;
  for (std::int32_t v = 0; v < source_vertices; ++v) landmarks.push_back({v, v});
  return landmarks;
}

Surface read_mesh_file(const std::string& file, const EvaluateOptions& options) {
  return read_surface(read_file(file), file, {.repair = repair_mode(options.repair)});
}

Correspondence map_of(const EvaluateOptions& options, std::int32_t source_vertices) {
  const std::string& file = options.map;
  Correspondence map = decode_npz(read_file(file));
  if (map.vertex.size() == static_cast<std::size_t>(source_vertices)) return map;
  throw EngineError(ErrorCode::invalid_parameter,
                    file + " maps " + std::to_string(map.vertex.size()) + " vertices, the source has " + std::to_string(source_vertices));
}

void print(const char* title, const MapError& error) {
  std::printf("%s: mean %.2f, median %.2f, 95%% below %.2f, largest %.2f (percent of the square root of the target's area), %d landmarks\n",
              title, 100 * error.mean, 100 * error.median, 100 * error.p95, 100 * error.max, error.scored);
  if (error.unscored > 0) std::printf("  %d landmarks at dropped vertices were left out\n", error.unscored);
}

}  // namespace

void add_evaluate_options(CLI::App& command, EvaluateOptions& options) {
  command.add_option("SRC", options.source, "Source mesh")->required();
  command.add_option("TGT", options.target, "Target mesh")->required();
  command.add_option("MAP", options.map, "The map to measure, as match writes it to an .npz file")->required();
  CLI::Option* landmarks = command
                               .add_option("--landmarks", options.landmarks,
                                           "Two lists of vertex numbers, from 1: row i of the first, on SRC, belongs to row i of the "
                                           "second, on TGT. Without it the vertices of equal number belong together")
                               ->expected(2);
  command
      .add_option("--mirrored", options.mirrored,
                  "A third list: the left-right mirrored places on TGT. A map that is nearer to it is called flipped")
      ->needs(landmarks);
  command.add_option("--repair", options.repair, "As the meshes were matched")
      ->check(CLI::IsMember({"fill", "none"}))
      ->capture_default_str();
}

int run_evaluate(const EvaluateOptions& options) {
  std::string subject = options.source;
  try {
    const std::int32_t source_vertices = read_mesh_file(options.source, options).uploaded_vertices();
    subject = options.target;
    const Surface target = read_mesh_file(options.target, options);
    subject = options.map;
    const Correspondence map = map_of(options, source_vertices);
    subject = "evaluate";
    const bool listed = !options.landmarks.empty();
    const std::vector<std::int32_t> source = listed ? read_landmark_file(options.landmarks[0]) : std::vector<std::int32_t>{};
    const MapError error = evaluate(
        map, target,
        listed ? pair_up(source, read_landmark_file(options.landmarks[1])) : identity(source_vertices, target.uploaded_vertices()));
    print("error", error);
    if (options.mirrored.empty()) return exit_success;
    const MapError mirrored = evaluate(map, target, pair_up(source, read_landmark_file(options.mirrored)));
    print("against the mirrored truth", mirrored);
    std::printf("flipped: %s\n", mirrored.mean < error.mean ? "yes" : "no");
    return exit_success;
  } catch (...) {
    return report_current_exception(subject);
  }
}

}  // namespace spherematch
