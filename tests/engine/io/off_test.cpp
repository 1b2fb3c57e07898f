#include "engine/io/off.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::expect_refusal;

constexpr std::string_view vertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
constexpr std::string_view faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

std::string tetrahedron_with(const std::string& header) { return header + std::string(vertices) + std::string(faces); }

void expect_tetrahedron(const PolygonMesh& mesh) {
  ASSERT_EQ(mesh.vertex_count(), 4);
  ASSERT_EQ(mesh.face_count(), 4);
  EXPECT_EQ(mesh.vertices, test::tetrahedron().vertices);
  EXPECT_EQ(mesh.indices, (std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}));
  EXPECT_EQ(mesh.offsets, (std::vector<std::int32_t>{0, 3, 6, 9, 12}));
}

std::string message_of(const std::string& text) {
  try {
    (void)read_off(text);
  } catch (const EngineError& error) {
    return error.what();
  }
  return "";
}

TEST(Off, ReadsEveryFormOfHeader) {
  for (const char* header :
       {"OFF\n4 4 6\n", "OFF\n4 4\n", "OFF 4 4 6\n", "OFF4 4 0\n", "4 4 0\n", "OFF\r\n4 4 0\r\n",
        "# made by hand\nOFF # keyword\n\n# counts\n4 4 0 # and no edges\n\n", "\xEF\xBB\xBFOFF\n4 4 0\n", "OFF\n4\n4\n"})
    expect_tetrahedron(read_off(tetrahedron_with(header)));
}

TEST(Off, SkipsNormalsColoursAndTextureCoordinates) {
  const std::string with_extras =
      "4 4 0\n0 0 0 0.1 0.2 0.3 1\n1 0 0 255 0 0\n0 1 0 9\n0 0 1\n3 0 2 1 255 0 0\n3 0 1 3 1.0 0.5 0.2 1\n3 1 2 3 7\n3 2 0 3\n";
  for (const char* keyword : {"OFF\n", "COFF\n", "NOFF\n", "CNOFF\n", "STOFF\n", "STCNOFF\n"})
    expect_tetrahedron(read_off(keyword + with_extras));
}

TEST(Off, AllowsLinesToBreakWithinAFaceAndNoLastLineEnd) {
  expect_tetrahedron(read_off("OFF\n4 4 0\n0 0\n0\n1 0 0\n0 1 0\n0 0 1\n3 0\n2 1\n3 0 1 3\n\n3 1 2 3\n3 2 0 3"));
}

TEST(Off, ReadsPolygonsOfAnySize) {
  const PolygonMesh mesh = read_off("OFF\n6 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n3 0 1 2\n4 0 1 2 3\n6 0 1 2 3 4 5\n");
  EXPECT_EQ(mesh.offsets, (std::vector<std::int32_t>{0, 3, 7, 13}));
  EXPECT_EQ(mesh.face(1).size(), 4U);
  EXPECT_EQ(mesh.face(2)[5], 5);
}

TEST(Off, KeepsVerticesBitForBit) {
  const TriMesh mesh = test::transformed(test::icosphere(2), 1e-7, test::some_rotation(), {1e3, -1, 1.0 / 3});
  const PolygonMesh read = read_off(write_off(mesh));
  EXPECT_EQ(read.vertices, mesh.vertices);
  EXPECT_EQ(read.indices, test::polygons(mesh).indices);
}

TEST(Off, TellsTheFormatByItsKeyword) {
  for (const char* text :
       {"OFF\n", "OFF 4 4 0", "OFF4 4 0", "COFF\n", "NOFF", "CNOFF", "STOFF\n", "4OFF", "nOFF", "  \n#x\nOFF", "OFF BINARY"})
    EXPECT_TRUE(is_off(text)) << text;
  for (const char* text : {"", "4 4 0", "ply\n", "solid x", "OFFSET 3", "off\n", "XOFF", "v 1 2 3"}) EXPECT_FALSE(is_off(text)) << text;
}

TEST(Off, RefusesBinaryAndOtherDimensions) {
  for (const char* text : {"OFF BINARY\n", "COFF BINARY\n", "4OFF\n4 4 0\n", "nOFF 5\n4 4 0\n", "N4OFF\n"})
    expect_refusal(ErrorCode::unsupported_format, [&] { (void)read_off(text); });
}

TEST(Off, RefusesMalformedFilesNamingTheLine) {
  EXPECT_EQ(message_of("OFF\n4 x 0\n"), "line 2: 'x' is not the number of faces");
  EXPECT_EQ(message_of("OFF\n-4 4 0\n"), "line 2: a count is negative");
  EXPECT_EQ(message_of("OFF"), "line 1: the file ends where the number of vertices should be");
  EXPECT_EQ(message_of("OFF\n4 4 0\n0 0 0\n1 0 0\n0 zero 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"),
            "line 5: 'zero' is not a coordinate");
  EXPECT_EQ(message_of("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1e999 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"),
            "line 5: '1e999' is too large for a coordinate");
  EXPECT_EQ(message_of("OFF\n4 4 0\n0 0 0\n1 0 0\n0 nan 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"),
            "line 5: a coordinate is not finite");
  EXPECT_EQ(message_of("OFF\n4 1 0\n" + std::string(vertices) + "3 0 1 4\n"), "line 7: vertex index 4 is not in 0 to 3");
  EXPECT_EQ(message_of("OFF\n4 1 0\n" + std::string(vertices) + "3 0 1 -1\n"), "line 7: vertex index -1 is not in 0 to 3");
  EXPECT_EQ(message_of("OFF\n4 1 0\n" + std::string(vertices) + "3 0 1 2.0\n"), "line 7: '2.0' is not a vertex index");
  EXPECT_EQ(message_of("OFF\n4 1 0\n" + std::string(vertices) + "2 0 1 2\n"), "line 7: a face has 2 corners");
  EXPECT_EQ(message_of("OFF\n4 1 0\n" + std::string(vertices) + "9 0 1 2\n"), "line 8: the file ends where a vertex index should be");
  for (const char* text : {"OFF\n4 4 0\nx", "OFF\n-1 4 0\n", "4", "OFF 3"})
    expect_refusal(ErrorCode::malformed_mesh, [&] { (void)read_off(text); });
}

TEST(Off, ChecksCountsAgainstTheBytesBeforeItAllocates) {
  for (const char* text : {"OFF\n4000000000000000000 4 0\n0 0 0\n", "OFF\n4 4000000000000000000 0\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n",
                           "OFF\n9223372036854775807 9223372036854775807 0\n", "OFF\n299999 3 0\n0 0 0\n"})
    expect_refusal(ErrorCode::malformed_mesh, [&] { (void)read_off(text); });
  EXPECT_EQ(message_of("OFF\n5 4 0\n0 0 0\n"), "line 3: the file is too short for 5 vertices and 4 faces");
}

TEST(Off, KeepsToTheLimits) {
  const std::string text = tetrahedron_with("OFF\n4 4 0\n");
  EXPECT_EQ(read_off(text, {.max_vertices = 4}).vertex_count(), 4);
  expect_refusal(ErrorCode::too_many_vertices, [&] { (void)read_off(text, {.max_vertices = 3}); });
  // Twelve corners are allowed for each vertex of the limit: sixteen triangles over four vertices are just within.
  const auto repeated = [](int times) {
    std::string mesh = "OFF\n4 " + std::to_string(4 * times) + " 0\n" + std::string(vertices);
    for (int i = 0; i < times; ++i) mesh += faces;
    return mesh;
  };
  EXPECT_EQ(read_off(repeated(4), {.max_vertices = 4}).face_count(), 16);
  expect_refusal(ErrorCode::too_many_vertices, [&] { (void)read_off(repeated(5), {.max_vertices = 4}); });
}

TEST(Off, RefusesAMeshOfNothing) {
  expect_refusal(ErrorCode::degenerate, [] { (void)read_off("OFF\n0 0 0\n"); });
  expect_refusal(ErrorCode::degenerate, [] { (void)read_off("OFF\n1 0 0\n0 0 0\n"); });
}

}  // namespace
}  // namespace spherematch
