#include "engine/io/obj.h"

#include <gtest/gtest.h>

#include "tests/engine/io/reading.h"
#include "tests/support/mesh_files.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

using test::expect_refused;
using test::expect_same;

constexpr ErrorCode malformed = ErrorCode::malformed_mesh;

const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string faces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

void expect_tetrahedron(const std::string& text) { expect_same(read_obj(text), test::polygons(test::tetrahedron()), text); }

TEST(Obj, ReadsEveryFormOfCorner) {
  for (const char* faces_text : {"f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n", "f 1/1 3/2 2/3\nf 1/1 2/1 4/1\nf 2/9 3/9 4/9\nf 3/1 1/1 4/1",
                                 "f 1//1 3//2 2//3\nf 1//5 2//5 4//5\nf 2//1 3//1 4//1\nf 3//1 1//1 4//1\n",
                                 "f 1/1/1 3/2/1 2/3/1\nf 1/-1/-2 2/1/1 4/1/1\nf 2/1/1 3/1/1 4/1/1\nf 3/1/1 1/1/1 4/1/1\n",
                                 "f -4 -2 -3\nf -4/1 -3/1 -1/-1\nf -3 -2 -1\nf -2 -4 -1\n", "f 1 3 2 # one\nf\t1 2 4\nf 2  3 4 \nf 3 1 4"})
    expect_tetrahedron(vertices + faces_text);
}

TEST(Obj, SkipsWhatIsNoGeometry) {
  expect_tetrahedron("# Blender\\\nmtllib a.mtl\no Thing#1\ng a b\nvn 0 0 1\nvt 0 0\nvp 1 2\n" + vertices +
                     "usemtl red\ns off\ns 1\nl 1 2\np 1 2 3\ncstype bspline\ncurv 0 1 \\\n1 2 3\nend\nunheard_of 1 2\n" + faces + "\n\n");
}

TEST(Obj, IgnoresWeightsAndColours) { expect_tetrahedron("v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 0.5 0.5 0.5\nv 0 0 1 red\n" + faces); }

TEST(Obj, JoinsLinesAtBackslashes) {
  expect_tetrahedron("v 0 \\\n0 0\nv 1 0 0\\\n\nv 0 1 \\\r\n0\nv 0 0 1\nf 1 3\\\n 2\nf 1 2 4\nf \\\n2 3 4\nf 3 1 4\n");
}

TEST(Obj, ReadsLineEndsOfEverySystem) {
  std::string text = vertices + faces;
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2)) text.replace(at, 1, "\r\n");
  expect_tetrahedron(text);
  expect_tetrahedron("\xEF\xBB\xBF" + text);
}

TEST(Obj, ReadsPolygonsAndFacesBeforeVertices) {
  const PolygonMesh mesh = read_obj("f 1 2 3 4\n" + vertices + "f 1 2 3\nf -1 -2 -3 -4\n");
  EXPECT_EQ(mesh.offsets, (std::vector<std::int32_t>{0, 4, 7, 11}));
  EXPECT_EQ(mesh.indices, (std::vector<std::int32_t>{0, 1, 2, 3, 0, 1, 2, 3, 2, 1, 0}));
}

TEST(Obj, IsToldByItsStatements) {
  for (const std::string& text : {vertices, std::string("# x\n\nmtllib a\no b\ng\nvt 1 2\nvn 0 0 1\nf 1 2 3\nv -1e3 0 0"),
                                  std::string("v .5 0 0"), std::string("\xEF\xBB\xBFv 1")})
    EXPECT_TRUE(is_obj(text)) << text;
  for (const char* text : {"", "\n", "# comment only", "o name\n", "v", "v x", "v\n1 2 3", "vertex 1 2 3", "version 1\nv 1 2 3",
                           "OFF\nv 1 2 3", "ply\nv 1 2 3", "solid v\nv 1 2 3", "f 1 2 3", "4 4 0\nv 0 0 0", "s", "{}"})
    EXPECT_FALSE(is_obj(text)) << text;
}

TEST(Obj, RefusesMalformedFilesNamingTheLine) {
  struct Case {
    std::string text;
    const char* message;
  };
  for (const auto& [text, message] : std::vector<Case>{
           {"v 0 0\nv 1 0 0\n", "line 1: the line ends where a coordinate should be"},
           {"v 0 0", "line 1: the file ends where a coordinate should be"},
           {"v 0 0 z\n", "line 1: 'z' is not a coordinate"},
           {"v 0 0 0\nv 0 nan 0\n", "line 2: a coordinate is not finite"},
           {"v 0 0 -inf\n", "line 1: a coordinate is not finite"},
           {"v 0 0 1e999\n", "line 1: '1e999' is too large for a coordinate"},
           {vertices + "f 1 2\n", "line 5: a face has 2 corners"},
           {vertices + "f\n", "line 5: a face has 0 corners"},
           {vertices + "f 0 1 2\n", "line 5: vertex numbers start at 1"},
           {vertices + "f 1 2 x\n", "line 5: 'x' is not a corner of a face"},
           {vertices + "f 1 2 3x\n", "line 5: '3x' is not a corner of a face"},
           {vertices + "f 1 2 3/x\n", "line 5: '3/x' is not a corner of a face"},
           {vertices + "f 1 2 3.5\n", "line 5: '3.5' is not a corner of a face"},
           {vertices + "f 1 2 99999999999999999999\n", "line 5: '99999999999999999999' is not a corner of a face"},
           {vertices + "f 1 2 -5\n", "line 5: there is no vertex number -5 among 4"},
           {vertices + "f 1 2 5\nf 1 2 3\n", "line 5: there is no vertex number 5 among 4"},
           {vertices + "f 1 2 3\nf 1 2 7\nf 1 2 5\n", "line 6: there is no vertex number 7 among 4"},
           {vertices + "f 1 2 4000000000\n", "line 5: there is no vertex number 4000000000 among 4"},
           {vertices + "\\\nf 1 2 5\n", "line 6: there is no vertex number 5 among 4"},
       })
    expect_refused(malformed, message, text, "a.obj");
}

TEST(Obj, KeepsToTheLimits) {
  const std::string text = vertices + faces;
  EXPECT_EQ(test::read(text, "", {.max_vertices = 4}).vertex_count(), 4);
  expect_refused(ErrorCode::too_many_vertices, "has 4 vertices; the limit is 3", text, "", {.max_vertices = 3});
  std::string many = vertices + "f";
  for (int i = 0; i < 48; ++i) many += " 1";
  EXPECT_EQ(test::read(many, "", {.max_vertices = 4}).indices.size(), 48U);
  expect_refused(ErrorCode::too_many_vertices, "line 5: the faces have more than 48 corners", many + " 1", "", {.max_vertices = 4});
}

TEST(Obj, RefusesFilesWithoutVerticesOrFaces) {
  expect_refused(ErrorCode::degenerate, "no vertices or no faces", vertices);
  expect_refused(ErrorCode::degenerate, "no vertices or no faces", "# nothing\n", "a.obj");
}

}  // namespace
}  // namespace spherematch
