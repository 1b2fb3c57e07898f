// The files in samples/ as a user finds them, read by the engine.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <sstream>

#include "engine/io/mesh_reader.h"
#include "engine/mesh/repair.h"
#include "samples/creature.h"
#include "tests/samples/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch::samples {
namespace {

const std::filesystem::path folder = SAMPLES_FOLDER;

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<int> landmarks_of(const std::filesystem::path& path) {
  std::istringstream in(bytes_of(path));
  return {std::istream_iterator<int>(in), {}};
}

std::filesystem::path mesh_path(const Creature& creature, const Pose& pose) {
  return folder / creature.name / (pose.name + (pose.kind == MeshKind::glb ? ".glb" : ".off"));
}

PolygonMesh mesh_of(const Creature& creature, const Pose& pose) {
  const std::string bytes = bytes_of(mesh_path(creature, pose));
  return read_mesh(std::as_bytes(std::span(bytes)), "");
}

Mesh triangles_of(const PolygonMesh& upload) {
  Mesh mesh;
  for (Eigen::Index v = 0; v < upload.vertices.rows(); ++v)
    mesh.vertices.push_back({upload.vertices(v, 0), upload.vertices(v, 1), upload.vertices(v, 2)});
  for (std::int32_t f = 0; f < upload.face_count(); ++f)
    mesh.triangles.push_back({upload.face(f)[0], upload.face(f)[1], upload.face(f)[2]});
  return mesh;
}

std::size_t self_intersections(const Mesh& mesh) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  Surface surface;
  std::vector<Surface::Vertex_index> vertices;
  for (const Vec3& p : mesh.vertices) vertices.push_back(surface.add_vertex({p.x, p.y, p.z}));
  const auto vertex = [&](int v) { return vertices[static_cast<std::size_t>(v)]; };
  for (const Triangle& t : mesh.triangles) surface.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  EXPECT_EQ(surface.number_of_faces(), mesh.triangles.size());
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(pairs));
  return pairs.size();
}

class SamplesShipped : public testing::TestWithParam<Creature (*)()> {
 protected:
  const Creature creature_ = GetParam()();
};

TEST_P(SamplesShipped, SixPosesOneOfEachSpecialKind) {
  ASSERT_EQ(creature_.poses.size(), 6u);
  std::multiset<MeshKind> kinds;
  for (const Pose& pose : creature_.poses) kinds.insert(pose.kind);
  EXPECT_EQ(kinds.count(MeshKind::independent), 1u);
  EXPECT_EQ(kinds.count(MeshKind::holed), 1u);
  EXPECT_EQ(kinds.count(MeshKind::glb), 1u);
}

TEST_P(SamplesShipped, EveryMeshIsASphereAndHasHolesOnlyWhereItShould) {
  for (const Pose& pose : creature_.poses) {
    SCOPED_TRACE(pose.name);
    const PolygonMesh upload = mesh_of(creature_, pose);
    EXPECT_GE(upload.vertex_count(), 5000);
    EXPECT_LE(upload.vertex_count(), 20000);
    if (pose.kind != MeshKind::holed) {
      const Surface surface = repair(upload, RepairMode::none);  // refuses what is not closed, oriented outward, of genus zero
      EXPECT_GT(test::signed_volume(surface.mesh), 0);
      continue;
    }
    const Surface surface = repair(upload, RepairMode::fill);
    RepairReport expected;
    expected.filled_loops = static_cast<std::int32_t>(creature_.holes.size());
    expected.added_vertices = surface.report.added_vertices;
    expected.added_faces = surface.report.added_faces;
    EXPECT_EQ(surface.report, expected) << "clean loops, and nothing else to repair";
    EXPECT_GT(test::signed_volume(surface.mesh), 0);
  }
}

TEST_P(SamplesShipped, TrianglesAreGoodAndDoNotCross) {
  for (const Pose& pose : creature_.poses) {
    SCOPED_TRACE(pose.name);
    const Mesh mesh = triangles_of(mesh_of(creature_, pose));
    const std::vector<double> angles = smallest_angles(mesh);
    EXPECT_GT(*std::min_element(angles.begin(), angles.end()), 8);
    EXPECT_LT(share_below(angles, 20), 0.005);
    EXPECT_LT(share_below(angles, 30), 0.05);
    EXPECT_EQ(self_intersections(mesh), 0u);
  }
}

TEST_P(SamplesShipped, SharedMeshesAreNumberedAlike) {
  const PolygonMesh first = mesh_of(creature_, creature_.poses.front());
  for (const Pose& pose : creature_.poses) {
    const PolygonMesh mesh = mesh_of(creature_, pose);
    const bool alike = pose.kind == MeshKind::shared || pose.kind == MeshKind::glb;
    EXPECT_EQ(mesh.indices == first.indices, alike) << pose.name;
  }
}

TEST_P(SamplesShipped, LandmarksAreOneToOneAndMirroringIsAnInvolution) {
  const std::vector<int> first = landmarks_of(folder / creature_.name / (creature_.poses.front().name + ".vts"));
  ASSERT_GE(first.size(), 500u);
  std::vector<std::size_t> first_mirror;
  for (const Pose& pose : creature_.poses) {
    SCOPED_TRACE(pose.name);
    const std::vector<int> here = landmarks_of(folder / creature_.name / (pose.name + ".vts"));
    const std::vector<int> there = landmarks_of(folder / creature_.name / (pose.name + ".sym.vts"));
    ASSERT_EQ(here.size(), first.size());
    ASSERT_EQ(there.size(), first.size());
    if (pose.kind == MeshKind::shared || pose.kind == MeshKind::glb) {
      EXPECT_EQ(here, first);
    }
    const int count = mesh_of(creature_, pose).vertex_count();
    std::map<int, std::size_t> row;
    for (std::size_t i = 0; i < here.size(); ++i) {
      EXPECT_TRUE(here[i] >= 1 && here[i] <= count);
      EXPECT_TRUE(row.emplace(here[i], i).second) << "landmark twice";
    }
    std::vector<std::size_t> mirror;
    for (const int v : there) mirror.push_back(row.at(v));
    for (std::size_t i = 0; i < mirror.size(); ++i) EXPECT_EQ(mirror[mirror[i]], i);
    if (first_mirror.empty()) first_mirror = mirror;
    EXPECT_EQ(mirror, first_mirror);
  }
}

INSTANTIATE_TEST_SUITE_P(All, SamplesShipped, testing::Values(&hound, &imp), [](const auto& info) { return info.param().name; });

TEST(SamplesShippedPairs, NameOffFilesOfOneCreatureEachWay) {
  const nlohmann::json pairs = nlohmann::json::parse(bytes_of(folder / "pairs.json")).at("pairs");
  EXPECT_GE(pairs.size(), 16u);
  EXPECT_LE(pairs.size(), 24u);
  std::set<std::vector<std::string>> seen;
  std::set<std::pair<std::string, std::string>> shapes;
  for (const nlohmann::json& pair : pairs) {
    const std::string set = pair.at("set"), source = pair.at("src"), target = pair.at("tgt");
    EXPECT_EQ(pair.at("truth"), "vts");
    EXPECT_NE(source, target);
    EXPECT_TRUE(seen.insert({set, source, target}).second);
    shapes.insert({set, source});
    EXPECT_EQ(bytes_of(folder / set / (source + ".off")).substr(0, 4), "OFF\n");
  }
  for (const std::vector<std::string>& s : seen) EXPECT_TRUE(seen.contains({s[0], s[2], s[1]}));
  for (const Creature& creature : {hound(), imp()})
    for (const Pose& pose : creature.poses) EXPECT_EQ(shapes.contains({creature.name, pose.name}), pose.kind != MeshKind::glb) << pose.name;
}

}  // namespace
}  // namespace spherematch::samples
