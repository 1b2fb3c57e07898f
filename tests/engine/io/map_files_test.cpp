// The PLY and OBJ files of a map, read by hand; map_glb_test.cpp has GLB.
#include <gtest/gtest.h>

#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "engine/io/map_mesh.h"
#include "engine/io/mesh_reader.h"
#include "tests/engine/io/some_maps.h"

namespace spherematch::test {
namespace {

PolygonMesh read_back(const std::string& file) { return read_mesh(std::as_bytes(std::span(file)), ""); }

/// The header's lines, and a cursor over what follows them.
struct Ply {
  std::vector<std::string> header;
  std::string body;
  std::size_t position = 0;

  explicit Ply(const std::string& file) {
    const std::string end = "end_header\n";
    const std::size_t length = file.find(end) + end.size();
    std::istringstream lines(file.substr(0, length));
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("comment ")) header.push_back(line);
    }
    body = file.substr(length);
  }
  template <typename Number>
  Number next() {
    Number number{};
    EXPECT_LE(position + sizeof number, body.size());
    std::memcpy(&number, body.substr(position, sizeof number).data(), sizeof number);
    position += sizeof number;
    return number;
  }
};

std::vector<std::string> expected_header(const std::string& real, const std::string& count, int vertices, int faces) {
  return {"ply",
          "format binary_little_endian 1.0",
          "element vertex " + std::to_string(vertices),
          "property " + real + " x",
          "property " + real + " y",
          "property " + real + " z",
          "property uchar red",
          "property uchar green",
          "property uchar blue",
          "property " + real + " tx",
          "property " + real + " ty",
          "property " + real + " tz",
          "element face " + std::to_string(faces),
          "property list " + count + " int vertex_indices",
          "end_header"};
}

/// Reads the whole body and compares it with the mesh.
template <typename Real, typename Count>
void expect_body(Ply ply, const MapMesh& painted) {
  for (Eigen::Index v = 0; v < painted.mesh.vertices.rows(); ++v) {
    for (int k = 0; k < 3; ++k) EXPECT_EQ(ply.next<Real>(), static_cast<Real>(painted.mesh.vertices(v, k)));
    for (int k = 0; k < 3; ++k) EXPECT_EQ(ply.next<std::uint8_t>(), painted.colors(v, k));
    for (int k = 0; k < 3; ++k) {
      const Real value = ply.next<Real>();
      if (std::isnan(painted.images(v, k))) {
        EXPECT_TRUE(std::isnan(value));
      } else {
        EXPECT_EQ(value, static_cast<Real>(painted.images(v, k)));
      }
    }
  }
  for (std::int32_t f = 0; f < painted.mesh.face_count(); ++f) {
    const auto face = painted.mesh.face(f);
    ASSERT_EQ(static_cast<std::size_t>(ply.next<Count>()), face.size());
    for (const std::int32_t vertex : face) EXPECT_EQ(ply.next<std::int32_t>(), vertex);
  }
  EXPECT_EQ(ply.position, ply.body.size());
}

/// A prism over a regular polygon, closed by two large polygons.
PolygonMesh prism(int corners) {
  Points vertices(2 * corners, 3);
  std::vector<std::vector<std::int32_t>> faces(2);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * M_PI * i / corners;
    vertices.row(2 * i) << std::cos(angle), std::sin(angle), 0;
    vertices.row(2 * i + 1) << std::cos(angle), std::sin(angle), 1;
    const int next = (i + 1) % corners;
    faces.push_back({2 * i, 2 * next, 2 * next + 1, 2 * i + 1});
    faces[0].push_back(2 * (corners - 1 - i));
    faces[1].push_back(2 * i + 1);
  }
  return polygons(vertices, faces);
}

TEST(MapPly, HoldsVerticesColorsImagesAndPolygons) {
  const MapMesh painted = painted_identity(cube());
  const std::string file = encode_ply(painted);
  EXPECT_EQ(Ply(file).header, expected_header("float", "uchar", 8, 6));
  expect_body<float, std::uint8_t>(Ply(file), painted);
  EXPECT_EQ(file, encode_ply(painted_identity(cube())));
}

TEST(MapPly, OnTheIdentityTheImageIsTheVertex) {
  const PolygonMesh sphere = polygons(icosphere(2));
  Ply ply(encode_ply(painted_identity(sphere)));
  for (std::int32_t v = 0; v < sphere.vertex_count(); ++v) {
    std::array<float, 3> place{};
    for (float& x : place) x = ply.next<float>();
    for (int k = 0; k < 3; ++k) (void)ply.next<std::uint8_t>();
    for (const float x : place) EXPECT_EQ(ply.next<float>(), x);
  }
}

TEST(MapPly, ADroppedVertexHasNoImage) {
  const MapMesh painted = painted_identity(sphere_and_stray());
  ASSERT_TRUE(std::isnan(painted.images(163, 0)));
  const std::string file = encode_ply(painted);
  EXPECT_EQ(Ply(file).header, expected_header("float", "uchar", 166, 324));
  expect_body<float, std::uint8_t>(Ply(file), painted);
}

TEST(MapPly, FarFromTheOriginNumbersAreDouble) {
  PolygonMesh far = polygons(icosphere(1));
  far.vertices.rowwise() += Eigen::RowVector3d(5e5, 4e6, 0);
  const MapMesh painted = painted_identity(far);
  EXPECT_EQ(Ply(encode_ply(painted)).header, expected_header("double", "uchar", 42, 80));
  expect_body<double, std::uint8_t>(Ply(encode_ply(painted)), painted);

  MapMesh far_target = painted_identity(polygons(icosphere(1)));
  far_target.images = painted.images;
  expect_body<double, std::uint8_t>(Ply(encode_ply(far_target)), far_target);
}

TEST(MapPly, QualityFollowsTheImage) {
  MapMesh painted = painted_identity(cube());
  painted.quality = {.distortion = {0, 1, 2, 3, 0, 0, 0, 0.5F}, .confidence = {1, 0.75F, 0, 0, 0, 0, 0, 0.25F}};
  for (const bool far : {false, true}) {
    if (far) painted.mesh.vertices.rowwise() += Eigen::RowVector3d(5e5, 4e6, 0);
    Ply ply(encode_ply(painted));
    EXPECT_EQ(ply.header[12], "property float confidence");
    EXPECT_EQ(ply.header[13], "property float distortion");
    const std::size_t others = far ? 6 * sizeof(double) + 3 : 6 * sizeof(float) + 3;
    for (std::size_t v = 0; v < 8; ++v) {
      ply.position += others;
      EXPECT_EQ(ply.next<float>(), painted.quality.confidence[v]);
      EXPECT_EQ(ply.next<float>(), painted.quality.distortion[v]);
    }
    EXPECT_EQ(read_back(encode_ply(painted)).vertices, painted.mesh.vertices);
  }
  painted.quality.confidence.clear();
  const Ply less(encode_ply(painted));
  EXPECT_EQ(less.header[12], "property float distortion");
  EXPECT_TRUE(less.header[13].starts_with("element face"));
}

TEST(MapPly, LargePolygonsFit) {
  const MapMesh small = painted_identity(prism(255));
  expect_body<float, std::uint8_t>(Ply(encode_ply(small)), small);
  const MapMesh large = painted_identity(prism(256));
  EXPECT_EQ(Ply(encode_ply(large)).header, expected_header("float", "int", 512, 258));
  expect_body<float, std::int32_t>(Ply(encode_ply(large)), large);
}

TEST(MapPly, ReadsBackAsTheUpload) {
  const PolygonMesh read = read_back(encode_ply(painted_identity(cube())));
  EXPECT_EQ(read.vertices, cube().vertices);
  EXPECT_EQ(read.offsets, cube().offsets);
  EXPECT_EQ(read.indices, cube().indices);
}

TEST(MapObj, HoldsVerticesColorsAndPolygons) {
  PolygonMesh mesh = cube();
  mesh.vertices.array() += 1.0 / 3;
  const MapMesh painted = painted_identity(mesh);
  const std::string file = encode_obj(painted);
  EXPECT_EQ(file, encode_obj(painted_identity(mesh)));
  std::istringstream lines(file);
  Eigen::Index vertex = 0;
  std::int32_t face = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      for (int k = 0; k < 3; ++k) {
        words >> word;
        EXPECT_EQ(std::stod(word), mesh.vertices(vertex, k)) << line;
      }
      for (int k = 0; k < 3; ++k) {
        words >> word;
        EXPECT_EQ(std::lround(255 * std::stod(word)), painted.colors(vertex, k)) << line;
      }
      ++vertex;
    } else if (word == "f") {
      for (const std::int32_t corner : mesh.face(face)) {
        words >> word;
        EXPECT_EQ(std::stoi(word), corner + 1) << line;
      }
      ++face;
    } else {
      EXPECT_EQ(word, "#") << line;
    }
    EXPECT_TRUE(word == "#" || (words >> std::ws).eof()) << line;
  }
  EXPECT_EQ(vertex, 8);
  EXPECT_EQ(face, 6);
}

TEST(MapObj, EachColorReadsBackAsTheSameByte) {
  PolygonMesh mesh = polygons(icosphere(2));
  MapMesh painted = painted_identity(mesh);
  for (int value = 0; value < 256; ++value) painted.colors(value / 3, value % 3) = static_cast<std::uint8_t>(value);
  std::istringstream lines(encode_obj(painted));
  std::string line;
  std::getline(lines, line);
  for (int v = 0; v < 85; ++v) {
    std::string key;
    double x = 0, y = 0, z = 0;
    std::array<double, 3> color{};
    lines >> key >> x >> y >> z >> color[0] >> color[1] >> color[2];
    for (int k = 0; k < 3; ++k) EXPECT_EQ(std::lround(255 * color[static_cast<std::size_t>(k)]), 3 * v + k);
  }
}

TEST(MapObj, ReadsBackAsTheUpload) {
  const PolygonMesh mesh = sphere_and_stray();
  const PolygonMesh read = read_back(encode_obj(painted_identity(mesh)));
  EXPECT_EQ(read.vertices, mesh.vertices);
  EXPECT_EQ(read.offsets, mesh.offsets);
  EXPECT_EQ(read.indices, mesh.indices);
}

}  // namespace
}  // namespace spherematch::test
