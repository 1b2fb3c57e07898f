// Every mesh of the measuring data, where it is at hand: SPHEREMATCH_SHARED names its folder, by default ../shared beside the sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "engine/io/mesh_reader.h"
#include "engine/mesh/repair.h"
#include "engine/mesh/zero_area.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

std::filesystem::path shared_folder() {
  const char* named = std::getenv("SPHEREMATCH_SHARED");
  return named != nullptr ? std::filesystem::path(named) : std::filesystem::path(SPHEREMATCH_SOURCE_DIR) / ".." / "shared";
}

std::vector<std::filesystem::path> shared_meshes() {
  std::vector<std::filesystem::path> files;
  const std::filesystem::path data = shared_folder() / "data";
  if (!std::filesystem::is_directory(data)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data))
    if (entry.path().extension() == ".off") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(SharedData, EveryMeshBecomesASphere) {
  const std::vector<std::filesystem::path> files = shared_meshes();
  if (files.empty()) GTEST_SKIP() << "no meshes under " << shared_folder() / "data";
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file.filename().string());
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
    const PolygonMesh mesh = read_mesh(std::as_bytes(std::span(bytes)), file.filename().string());
    const Surface surface = repair(mesh, RepairMode::fill);
    test::expect_invariants(surface, mesh);
    // These have holes at most: nothing but patches is added, and nothing is lost.
    const RepairReport& report = surface.report;
    EXPECT_EQ(report, (RepairReport{.filled_loops = report.filled_loops, .added_faces = report.added_faces}));
    if (report.filled_loops > 0)
      test::expect_refusal(ErrorCode::not_closed, [&] { (void)repair(mesh, RepairMode::none); });
    else
      EXPECT_EQ(repair(mesh, RepairMode::none).mesh.faces, surface.mesh.faces);
  }
}

}  // namespace
}  // namespace spherematch
