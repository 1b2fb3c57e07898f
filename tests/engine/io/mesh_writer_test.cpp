#include "engine/io/mesh_writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/mesh/repair.h"
#include "tests/engine/io/glb_parts.h"
#include "tests/engine/io/reading.h"
#include "tests/support/meshes.h"

namespace spherematch::test {
namespace {

/// Doubles that no float has, moved and scaled.
PolygonMesh awkward(double scale, double shift) {
  PolygonMesh mesh = polygons(creature(2));
  mesh.vertices = (mesh.vertices * (scale * 0.1)).array() + shift;
  return mesh;
}

/// A box of quadrilaterals with a pentagon on top, and a vertex of no face.
PolygonMesh with_polygons() {
  Points vertices(10, 3);
  vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 0.5, -0.1, 1, 9, 9, 9;
  return polygons(vertices, {{0, 3, 2, 1}, {4, 8, 5, 6, 7}, {0, 1, 5, 8, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

TEST(MeshWriter, KnowsItsFormatsByName) {
  for (const auto& [name, format] :
       {std::pair("off", MeshFormat::off), std::pair("obj", MeshFormat::obj), std::pair("ply", MeshFormat::ply),
        std::pair("stl", MeshFormat::stl), std::pair("glb", MeshFormat::glb)}) {
    EXPECT_EQ(mesh_format_named(name), format);
    const std::string file = encode_mesh(format, with_polygons());
    EXPECT_EQ(mesh_format_of(std::as_bytes(std::span(file)), ""), name);
    EXPECT_EQ(file, encode_mesh(format, with_polygons()));
  }
  for (const char* name : {"", "OFF", "gltf", "original"}) EXPECT_EQ(mesh_format_named(name), std::nullopt) << name;
}

TEST(MeshWriter, TextAndPlyLoseNothing) {
  for (const PolygonMesh& mesh : {with_polygons(), cube(), awkward(1, 0), awkward(1, 1e7), awkward(1e-200, 0), awkward(1e200, 0)}) {
    for (const MeshFormat format : {MeshFormat::off, MeshFormat::obj, MeshFormat::ply}) expect_same(read(encode_mesh(format, mesh)), mesh);
  }
}

TEST(MeshWriter, PlyIsOnlyAsWideAsItMustBe) {
  EXPECT_NE(encode_mesh(MeshFormat::ply, cube()).find("property float x"), std::string::npos);
  EXPECT_NE(encode_mesh(MeshFormat::ply, cube()).find("property list uchar int"), std::string::npos);
  EXPECT_NE(encode_mesh(MeshFormat::ply, awkward(1, 0)).find("property double x"), std::string::npos);
  std::vector<std::int32_t> ring(300);
  Points vertices(300, 3);
  for (int i = 0; i < 300; ++i) {
    ring[static_cast<std::size_t>(i)] = i;
    vertices.row(i) << std::cos(i * 0.02), std::sin(i * 0.02), 0;
  }
  const PolygonMesh large = polygons(vertices, {ring});
  EXPECT_NE(encode_mesh(MeshFormat::ply, large).find("property list int int"), std::string::npos);
  expect_same(read(encode_mesh(MeshFormat::ply, large)), large);
}

TEST(MeshWriter, PlyMayHaveNotANumber) {
  PolygonMesh mesh = cube();
  mesh.vertices.row(3).setConstant(std::numeric_limits<double>::quiet_NaN());
  const std::string file = encode_mesh(MeshFormat::ply, mesh);
  EXPECT_NE(file.find("property float x"), std::string::npos);
  float value = 0;
  std::memcpy(&value, file.data() + file.find("end_header\n") + 11 + 3 * 12, sizeof value);
  EXPECT_TRUE(std::isnan(value));
}

/// Triangles as the positions of their corners.
Points corners_of(const PolygonMesh& mesh) {
  Points corners(static_cast<Eigen::Index>(mesh.indices.size()), 3);
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) corners.row(static_cast<Eigen::Index>(i)) = mesh.vertices.row(mesh.indices[i]);
  return corners;
}

TEST(MeshWriter, StlHasTheTrianglesInOrder) {
  const PolygonMesh mesh = polygons(icosphere(2));
  const std::string file = encode_mesh(MeshFormat::stl, mesh);
  EXPECT_EQ(file.size(), 84U + 50U * 320);
  EXPECT_LT((corners_of(read(file)) - corners_of(mesh)).cwiseAbs().maxCoeff(), 1e-6);
  for (std::size_t f = 0; f < 320; ++f) {
    Eigen::Vector3f normal;
    std::memcpy(normal.data(), file.data() + 84 + 50 * f, 12);
    EXPECT_NEAR(normal.norm(), 1, 1e-6);
    EXPECT_GT(normal.dot(mesh.vertices.row(mesh.indices[3 * f]).cast<float>()), 0.9F);
  }
  // Six polygons, one of which is a pentagon and one has five corners too.
  EXPECT_EQ(read(encode_mesh(MeshFormat::stl, with_polygons())).face_count(), 14);
}

TEST(MeshWriter, StlIsTextWhereFloatWouldBlur) {
  for (const PolygonMesh& mesh : {awkward(1, 1e7), awkward(1e100, 0), awkward(1e-100, 0)}) {
    const std::string file = encode_mesh(MeshFormat::stl, mesh);
    EXPECT_TRUE(file.starts_with("solid "));
    EXPECT_EQ(corners_of(read(file)), corners_of(mesh));
    EXPECT_EQ(file.find("nan"), std::string::npos);
    EXPECT_EQ(file.find("inf"), std::string::npos);
  }
}

TEST(MeshWriter, GlbHasNoColors) {
  const PolygonMesh mesh = cube();
  const std::string file = encode_mesh(MeshFormat::glb, mesh);
  const Glb glb(file);
  EXPECT_EQ(glb.normals().size(), 24U);
  EXPECT_FALSE(glb.primitive()["attributes"].contains("COLOR_0"));
  EXPECT_FALSE(glb.json["nodes"][0].contains("name"));
  EXPECT_EQ(read(file).vertices, mesh.vertices);
  EXPECT_EQ(read(file).face_count(), 12);
}

}  // namespace
}  // namespace spherematch::test
