#include <CLI/CLI.hpp>
#include <cstdio>
#include <utility>

#include "cli/commands.h"
#include "cli/exit_code.h"

namespace spherematch {

namespace {

void print_repair(const RepairReport& report) {
  const std::pair<const char*, std::int32_t> counts[] = {
      {"filled loops", report.filled_loops},
      {"added vertices", report.added_vertices},
      {"added faces", report.added_faces},
      {"dropped vertices", report.dropped_vertices},
      {"welded vertices", report.welded_vertices},
      {"split vertices", report.split_vertices},
      {"flipped faces", report.flipped_faces},
      {"removed faces", report.removed_faces},
      {"dropped components", report.dropped_components},
  };
  for (const auto& [name, count] : counts) {
    if (count != 0) std::printf("  repair: %s %d\n", name, count);
  }
}

void print_preparation(const std::string& mesh, const Preparation& preparation) {
  const PreprocessedShape& shape = *preparation.shape;
  std::printf("%s: %d vertices, %d faces, id %s%s\n", mesh.c_str(), shape.surface.uploaded_vertices(), shape.surface.uploaded_faces,
              preparation.id.c_str(), preparation.was_stored ? ", already in the store" : "");
  print_repair(shape.surface.report);
  if (shape.surface.decimated) std::printf("  simplified to %td vertices\n", shape.surface.decimated->mesh.vertex_count());
  print_seconds(shape.seconds);
  std::printf("  sphere: flipped %d, solid angle defect %.1e, area distortion %.3f\n", shape.sphere_quality.flipped,
              shape.sphere_quality.solid_angle_defect, shape.sphere_quality.area_distortion);
  std::fflush(stdout);
}

}  // namespace

void add_prepare_options(CLI::App& command, PrepareOptions& options) {
  command.add_option("MESH", options.meshes, "Mesh files")->required();
  add_common_options(command, options);
}

int run_prepare(const PrepareOptions& options) {
  ShapeStore store(options.store);
  int result = exit_success;
  for (const std::string& mesh : options.meshes) {
    try {
      print_preparation(mesh, prepare_file(store, mesh, options.preparation()));
    } catch (...) {
      const int code = report_current_exception(mesh);
      if (result == exit_success) result = code;
    }
  }
  return result;
}

}  // namespace spherematch
