#include "engine/io/scene.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "engine/io/mesh_reader.h"
#include "tests/engine/io/glb_parts.h"
#include "tests/engine/io/reading.h"
#include "tests/engine/io/some_maps.h"

namespace spherematch::test {
namespace {

const SceneNames names{"left \"one\"", "right"};

PolygonMesh moved(PolygonMesh mesh, double scale, const Eigen::RowVector3d& shift) {
  mesh.vertices = (scale * mesh.vertices).rowwise() + shift;
  return mesh;
}

/// The same sphere in two places, each vertex mapped to itself.
struct Pair {
  PolygonMesh source;
  PolygonMesh target;
  Surface target_surface = repair(target, RepairMode::fill);
  [[nodiscard]] std::string scene() const { return encode_scene(source, target, identity_map(target_surface), target_surface, names); }
};

TEST(Scene, BothMeshesStandSideBySide) {
  const PolygonMesh sphere = polygons(icosphere(2));
  const Pair pair{moved(sphere, 1, {5, 6, 7}), moved(sphere, 2, {-40, 0, 3})};
  const std::string file = pair.scene();
  const PolygonMesh both = read(file);
  ASSERT_EQ(both.vertex_count(), 324);
  const Points left = both.vertices.topRows(162);
  const Points right = both.vertices.bottomRows(162);
  EXPECT_LT((left - pair.source.vertices).cwiseAbs().maxCoeff(), 1e-5);
  const Points shift = right - pair.target.vertices;
  EXPECT_LT((shift.rowwise() - shift.row(0)).cwiseAbs().maxCoeff(), 1e-5);
  const double extent = right.col(0).maxCoeff() - right.col(0).minCoeff();
  EXPECT_NEAR(right.col(0).minCoeff() - left.col(0).maxCoeff(), 0.2 * extent, 1e-5);
  for (int k = 1; k < 3; ++k) {
    EXPECT_NEAR(right.col(k).minCoeff() + right.col(k).maxCoeff(), left.col(k).minCoeff() + left.col(k).maxCoeff(), 1e-5);
  }
  EXPECT_EQ(file, pair.scene());
}

TEST(Scene, NodesAreNamedAndCorrespondingPointsShareAColor) {
  const PolygonMesh sphere = polygons(creature(2));
  Glb scene(Pair{moved(sphere, 3, {1, 1, 1}), sphere}.scene());
  ASSERT_EQ(scene.json["nodes"].size(), 2U);
  EXPECT_EQ(scene.json["scenes"][0]["nodes"], Glb::Json::parse("[0,1]"));
  EXPECT_EQ(scene.json["nodes"][0]["name"], names.source);
  EXPECT_EQ(scene.json["nodes"][1]["name"], names.target);
  EXPECT_EQ(scene.json["nodes"][1]["mesh"], 1);
  const std::vector<std::uint8_t> source = scene.colors();
  scene.mesh = 1;
  EXPECT_EQ(scene.colors(), source);
  EXPECT_EQ(scene.indices(), std::vector<std::uint32_t>(sphere.indices.begin(), sphere.indices.end()));
  const MapMesh painted = painted_identity(sphere);
  for (Eigen::Index v = 0; v < painted.colors.rows(); ++v) {
    for (int k = 0; k < 3; ++k) ASSERT_EQ(source[static_cast<std::size_t>(4 * v + k)], painted.colors(v, k));
  }
}

TEST(Scene, ADroppedTargetVertexIsGray) {
  const PolygonMesh upload = sphere_and_stray();
  Glb scene(Pair{upload, upload}.scene());
  for (scene.mesh = 0; scene.mesh < 2; ++scene.mesh) {
    const std::vector<std::uint8_t> colors = scene.colors();
    for (std::size_t i = 4U * 162; i < colors.size(); ++i) EXPECT_EQ(colors[i], i % 4 == 3 ? 255 : 128);
  }
}

TEST(Scene, FarAndFarthestCoordinatesStayFinite) {
  const PolygonMesh sphere = polygons(icosphere(2));
  const Pair far{moved(sphere, 1, {4e6, 0, 0}), moved(sphere, 1, {0, -4e6, 0})};
  Glb scene(far.scene());
  const auto right = scene.json["nodes"][1];
  EXPECT_NEAR(right["translation"][0].get<double>(), 4e6 + 2.4, 0.1);
  EXPECT_NEAR(right["translation"][1].get<double>(), 0, 0.1);

  Pair farthest{sphere, sphere};
  for (PolygonMesh* mesh : {&farthest.source, &farthest.target}) mesh->vertices.row(5).setConstant(1e308);
  for (const auto& node : Glb(farthest.scene()).json["nodes"]) EXPECT_TRUE(node["translation"][0].is_number());
}

TEST(Scene, MeshesOfAnotherShapeAreRefused) {
  const PolygonMesh sphere = polygons(icosphere(1));
  Pair pair{sphere, sphere};
  pair.source = polygons(icosphere(2));
  EXPECT_THROW((void)pair.scene(), std::invalid_argument);
  std::swap(pair.source, pair.target);
  EXPECT_THROW((void)pair.scene(), std::invalid_argument);
}

}  // namespace
}  // namespace spherematch::test
