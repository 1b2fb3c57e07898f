// The GLB file of a map, taken apart, and read back by the engine's reader.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/io/map_mesh.h"
#include "engine/io/mesh_reader.h"
#include "tests/engine/io/glb_parts.h"
#include "tests/engine/io/some_maps.h"

namespace spherematch::test {
namespace {

TEST(MapGlb, HoldsPositionsColorsAndTriangles) {
  const PolygonMesh sphere = polygons(icosphere(2));
  const MapMesh painted = painted_identity(sphere);
  const Glb glb(encode_glb(painted));
  const std::vector<float> positions = glb.positions();
  ASSERT_EQ(positions.size(), 3U * 162);
  for (Eigen::Index i = 0; i < sphere.vertices.size(); ++i)
    EXPECT_EQ(positions[static_cast<std::size_t>(i)], static_cast<float>(sphere.vertices.data()[i]));
  EXPECT_EQ(glb.accessor("COLOR_0")["normalized"], true);
  const std::vector<std::uint8_t> colors = glb.colors();
  for (Eigen::Index v = 0; v < 162; ++v) {
    for (int k = 0; k < 3; ++k) EXPECT_EQ(colors[static_cast<std::size_t>(4 * v + k)], painted.colors(v, k));
    EXPECT_EQ(colors[static_cast<std::size_t>(4 * v + 3)], 255);
  }
  const std::vector<std::uint32_t> indices = glb.indices();
  EXPECT_EQ(std::vector<std::int32_t>(indices.begin(), indices.end()), sphere.indices);
  EXPECT_EQ(glb.json["materials"][0]["doubleSided"], true);
  EXPECT_FALSE(glb.json["nodes"][0].contains("translation"));
  EXPECT_EQ(encode_glb(painted), encode_glb(painted_identity(sphere)));
}

TEST(MapGlb, BoundsAreThoseOfTheNumbers) {
  PolygonMesh mesh = polygons(creature(3));
  mesh.vertices *= 0.1;  // no float has the value of most of these decimals
  const Glb glb(encode_glb(painted_identity(mesh)));
  const std::vector<float> positions = glb.positions();
  for (std::size_t k = 0; k < 3; ++k) {
    float low = positions[k], high = positions[k];
    for (std::size_t i = k; i < positions.size(); i += 3) {
      low = std::min(low, positions[i]);
      high = std::max(high, positions[i]);
    }
    EXPECT_EQ(glb.accessor("POSITION")["min"][k].get<double>(), static_cast<double>(low));
    EXPECT_EQ(glb.accessor("POSITION")["max"][k].get<double>(), static_cast<double>(high));
  }
}

TEST(MapGlb, NormalsAreUnitAndPointOutward) {
  PolygonMesh mesh = polygons(icosphere(3));
  const std::vector<float> normals = Glb(encode_glb(painted_identity(mesh))).normals();
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const Eigen::Vector3f normal(normals.data() + 3 * v);
    EXPECT_NEAR(normal.norm(), 1, 1e-6);
    EXPECT_GT(normal.dot(mesh.vertices.row(v).cast<float>()), 0.99F);
  }
  // A vertex of no face has a normal all the same.
  MapMesh lonely = painted_identity(mesh);
  lonely.mesh.vertices.conservativeResize(643, 3);
  lonely.mesh.vertices.row(642).setConstant(9);
  lonely.images.conservativeResize(643, 3);
  lonely.colors.conservativeResize(643, 3);
  const std::vector<float> more = Glb(encode_glb(lonely)).normals();
  EXPECT_EQ(std::vector<float>(more.end() - 3, more.end()), (std::vector<float>{0, 0, 1}));
}

TEST(MapGlb, PolygonsBecomeTriangles) {
  const PolygonMesh mesh = cube();
  const Glb glb(encode_glb(painted_identity(mesh)));
  const std::vector<std::uint32_t> indices = glb.indices();
  ASSERT_EQ(indices.size(), 36U);
  TriMesh triangles{.vertices = mesh.vertices, .faces = Triangles(12, 3)};
  for (Eigen::Index i = 0; i < 36; ++i) triangles.faces.data()[i] = static_cast<std::int32_t>(indices[static_cast<std::size_t>(i)]);
  EXPECT_NO_THROW((void)repair(polygons(triangles), RepairMode::none));  // closed and oriented
  const std::string file = encode_glb(painted_identity(mesh));
  const PolygonMesh read = read_mesh(std::as_bytes(std::span(file)), "");
  EXPECT_EQ(read.vertices, mesh.vertices);
  EXPECT_EQ(read.face_count(), 12);
}

TEST(MapGlb, AConcavePolygonDoesNotFoldOver) {
  // A dart whose reflex corner is its second, so that the fan of the first corner would leave it.
  Points vertices(4, 3);
  vertices << 0, 0, 0, 1, 0.2, 0, 4, 0, 0, 1, 3, 0;
  for (int shift = 0; shift < 4; ++shift) {
    std::vector<std::int32_t> face;
    for (int i = 0; i < 4; ++i) face.push_back((i + shift) % 4);
    MapMesh painted{.mesh = polygons(vertices, {face}), .images = vertices, .colors = Colors::Zero(4, 3)};
    const std::vector<std::uint32_t> indices = Glb(encode_glb(painted)).indices();
    ASSERT_EQ(indices.size(), 6U);
    for (std::size_t t = 0; t < 6; t += 3) {
      const auto corner = [&](std::size_t k) { return Eigen::Vector3d(vertices.row(indices[t + k])); };
      EXPECT_GT((corner(1) - corner(0)).cross(corner(2) - corner(0)).z(), 0) << shift;
    }
  }
}

TEST(MapGlb, FarFromTheOriginTheNodeTakesTheOffset) {
  for (const auto& [scale, shift] : {std::pair{1.0, 4e6}, {1e50, 0.0}, {1e-50, 0.0}}) {
    PolygonMesh mesh = polygons(icosphere(2));
    mesh.vertices = (mesh.vertices * scale).eval();
    mesh.vertices.col(1).array() += shift;
    const Glb glb(encode_glb(painted_identity(mesh)));
    const Glb::Json& node = glb.json["nodes"][0];
    const std::vector<float> positions = glb.positions();
    for (Eigen::Index i = 0; i < mesh.vertices.size(); ++i) {
      const auto k = static_cast<std::size_t>(i % 3);
      const double position = static_cast<double>(positions[static_cast<std::size_t>(i)]);
      EXPECT_LE(std::abs(position), 2);
      EXPECT_NEAR(node["translation"][k].get<double>() + node["scale"][k].get<double>() * position, mesh.vertices.data()[i], 1e-6 * scale);
    }
  }
}

TEST(MapGlb, TheFarthestPointsAreStillValid) {
  MapMesh painted = painted_identity(polygons(icosphere(1)));
  painted.mesh.vertices.row(5).setConstant(1e308);
  painted.mesh.vertices.row(6).setConstant(-1e308);
  const Glb glb(encode_glb(painted));  // parses: no number became infinite
  for (const float position : glb.positions()) EXPECT_TRUE(std::isfinite(position));
  for (const float normal : glb.normals()) EXPECT_TRUE(std::isfinite(normal));
}

}  // namespace
}  // namespace spherematch::test
