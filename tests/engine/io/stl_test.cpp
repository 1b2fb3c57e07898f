#include "engine/io/stl.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/io/distinct_points.h"
#include "tests/engine/io/reading.h"
#include "tests/support/mesh_files.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

using test::expect_refused;
using test::expect_same;
using test::with;

constexpr ErrorCode malformed = ErrorCode::malformed_mesh;

PolygonMesh tetrahedron() { return test::fit_for_every_format(test::tetrahedron()); }
std::string ascii() { return test::ascii_stl_file(tetrahedron()); }
std::string binary() { return test::binary_stl_file(tetrahedron()); }

/// Puts a float at the k-th coordinate of the file's corners.
std::string with_coordinate(std::string bytes, std::size_t triangle, std::size_t k, float value) {
  std::string number;
  test::append_number(number, value);
  return bytes.replace(84 + 50 * triangle + 12 + 4 * k, 4, number);
}

TEST(Stl, ReadsBothEncodings) {
  const PolygonMesh mesh = test::fit_for_every_format(test::creature(3));
  expect_same(read_stl(test::ascii_stl_file(mesh)), mesh);
  expect_same(read_stl(test::binary_stl_file(mesh)), mesh);
}

TEST(Stl, ReadsBinaryFilesWhoseTitleStartsWithSolid) {
  const std::string bytes = binary().replace(0, 5, "solid");
  expect_same(test::read(bytes, "a.obj"), tetrahedron());
}

TEST(Stl, NumbersDistinctPositionsByFirstAppearance) {
  // Both zeros are one position; an equal number in other digits too.
  const PolygonMesh mesh = read_stl(
      "solid\nfacet normal 0 0 1 outer loop vertex 1 0 0 vertex 0 0 0 vertex 0 1 0 endloop endfacet\n"
      "facet normal 0 0 1 outer loop vertex -0.0 0 -0 vertex 1.0e0 0 0 vertex 0 0 1 endloop endfacet\nendsolid\n");
  EXPECT_EQ(mesh.indices, (std::vector<std::int32_t>{0, 1, 2, 1, 0, 3}));
  EXPECT_EQ(mesh.vertex_count(), 4);
  EXPECT_EQ(mesh.vertices.row(0), Eigen::RowVector3d(1, 0, 0));
  const PolygonMesh from_binary = read_stl(with_coordinate(binary(), 1, 0, -0.0F));
  expect_same(from_binary, tetrahedron());
}

TEST(Stl, KeepsTrianglesWithEqualCorners) {
  const PolygonMesh mesh = read_stl(
      ascii() + "solid b\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid b");
  EXPECT_EQ(mesh.face_count(), 5);
  EXPECT_EQ(mesh.face(4)[0], mesh.face(4)[1]);
}

TEST(Stl, ReadsTextOfManyWriters) {
  std::string upper = ascii();
  for (char& c : upper)
    if (c >= 'a' && c <= 'z' && c != 'e') c = static_cast<char>(c - 'a' + 'A');
  expect_same(read_stl(upper), tetrahedron());
  expect_same(read_stl(with(ascii(), "solid it", "solid")), tetrahedron());
  expect_same(read_stl(with(ascii(), "solid it", "  solid a facet # of \"things\" ")), tetrahedron());
  expect_same(read_stl("\xEF\xBB\xBF" + ascii()), tetrahedron());
  expect_same(read_stl(with(ascii(), "normal 0 0 0", "normal nan -nan(ind) 1#INF")), tetrahedron());
  expect_same(read_stl(with(ascii(), "normal 0 0 0", "")), tetrahedron());
  // Two solids instead of one
  const std::string text = ascii();
  const std::size_t middle = text.find("  facet", text.find("endfacet"));
  expect_same(read_stl(text.substr(0, middle) + "endsolid\n\nsolid second\n" + text.substr(middle)), tetrahedron());
}

TEST(Stl, IsToldByItsLengthOrItsFirstWord) {
  for (const std::string& bytes : {ascii(), binary(), std::string("SOLID x"), std::string(" \n solid"), std::string(84, '\0')})
    EXPECT_TRUE(is_stl(bytes)) << bytes;
  for (const std::string& bytes : {std::string(), binary() + '\n', binary().substr(0, 200), std::string(83, '\0'), std::string("solids")})
    EXPECT_FALSE(is_stl(bytes)) << bytes;
}

TEST(Stl, RefusesMalformedFilesNamingThePlace) {
  struct Case {
    std::string bytes;
    const char* message;
  };
  const std::string text = ascii();
  for (const auto& [bytes, message] : std::vector<Case>{
           {"solid", "line 1: the file ends where 'endsolid' should be"},
           {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "line 5: the file ends where 'vertex' should be"},
           {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0", "line 4: the file ends where a coordinate should be"},
           {with(text, "outer", "inner"), "line 3: 'inner' stands where 'outer' should be"},
           {with(text, "normal 0 0 0", "normal 0 0 0 0"), "line 2: '0' stands where 'outer' should be"},
           {with(text, "facet", "face"), "line 2: 'face' stands where 'endsolid' should be"},
           {with(text, "    endloop", "vertex 0 0 0 endloop"), "line 7: 'vertex' stands where 'endloop' should be"},
           {with(text, "vertex 1 0 0", "vertex 1 0 nan"), "a coordinate is not finite"},
           {with(text, "vertex 1 0 0", "vertex 1 0 1e400"), "'1e400' is too large for a coordinate"},
           {text + "more", "'more' stands where 'solid' should be"},
           {with(text, "endsolid it\n", ""), "the file ends where 'endsolid' should be"},
           {with_coordinate(binary(), 1, 2, std::numeric_limits<float>::quiet_NaN()), "byte 158: the coordinate before is not finite"},
           {with_coordinate(binary(), 0, 0, -std::numeric_limits<float>::infinity()), "byte 100: the coordinate before is not finite"},
       })
    expect_refused(malformed, message, bytes);
}

TEST(Stl, ComparesTheNumberOfTrianglesWithTheLength) {
  expect_refused(malformed, "byte 40: the file ends within the header", binary().substr(0, 40), "a.stl");
  expect_refused(malformed, "byte 80: a binary STL file of 4 triangles has 284 bytes, this one has 283", binary().substr(0, 283), "a.stl");
  expect_refused(malformed, "this one has 285", binary() + '\n', "a.stl");
  expect_refused(malformed, "of 4294967295 triangles has 214748364834 bytes", binary().replace(80, 4, "\xFF\xFF\xFF\xFF"), "a.stl");
  // Binary with a title as of text: the message still speaks of the length.
  const std::string damaged = binary().replace(0, 5, "solid");
  expect_refused(malformed, "of 4 triangles has 284 bytes, this one has 200", damaged.substr(0, 200));
}

TEST(Stl, KeepsToTheLimits) {
  for (const std::string& bytes : {ascii(), binary()}) {
    EXPECT_EQ(test::read(bytes, "", {.max_vertices = 4}).vertex_count(), 4);
    expect_refused(ErrorCode::too_many_vertices, "has 4 vertices; the limit is 3", bytes, "", {.max_vertices = 3});
  }
  PolygonMesh many = tetrahedron();
  for (int i = 0; i < 13; ++i) {
    many.indices.insert(many.indices.end(), {0, 1, 2});
    many.offsets.push_back(many.offsets.back() + 3);
  }
  for (const std::string& bytes : {test::ascii_stl_file(many), test::binary_stl_file(many)})
    expect_refused(ErrorCode::too_many_vertices, "the faces have more than 48 corners", bytes, "", {.max_vertices = 4});
}

TEST(Stl, RefusesFilesWithoutTriangles) {
  expect_refused(ErrorCode::degenerate, "no vertices or no faces", "solid nothing\nendsolid nothing\n");
  expect_refused(ErrorCode::degenerate, "no vertices or no faces", std::string(84, '\0'));
}

TEST(DistinctPoints, AgreeWithComparingAll) {
  // Few values in each coordinate, so that points differ in one of them only and many come again; enough of them to grow often.
  DistinctPoints numbered;
  std::vector<std::array<double, 3>> seen;
  std::uint32_t state = 1;
  const auto value = [&] { return static_cast<double>((state = state * 1664525 + 1013904223) >> 29) - 4.0; };
  for (int i = 0; i < 2000; ++i) {
    const std::array<double, 3> point{value(), 1e-300 * value(), value()};
    const auto known = std::find(seen.begin(), seen.end(), point);
    const auto expected = static_cast<std::int32_t>(known - seen.begin());
    if (known == seen.end()) seen.push_back(point);
    ASSERT_EQ(numbered.number_of(point), expected);
  }
  const Points points = numbered.points();
  ASSERT_EQ(points.rows(), static_cast<Eigen::Index>(seen.size()));
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(points(static_cast<Eigen::Index>(i), 1), seen[i][1]);
}

TEST(DistinctPoints, GrowPastTheFirstTable) {
  DistinctPoints numbered;
  for (std::int32_t round = 0; round < 2; ++round)
    for (std::int32_t i = 0; i < 50000; ++i) ASSERT_EQ(numbered.number_of({0, static_cast<double>(i) * 4294967296.0, 0}), i);
  EXPECT_EQ(numbered.count(), 50000);
}

}  // namespace
}  // namespace spherematch
