#include "engine/io/ply.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/engine/io/reading.h"
#include "tests/support/mesh_files.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

using test::append_number;
using test::expect_refused;
using test::expect_same;
using test::PlyKind;
using test::with;

constexpr ErrorCode malformed = ErrorCode::malformed_mesh;

PolygonMesh tetrahedron() { return test::polygons(test::tetrahedron()); }

std::string ascii() { return test::ply_file(tetrahedron(), PlyKind::ascii); }
std::string binary() { return test::ply_file(tetrahedron(), PlyKind::little_endian); }

/// A binary header of the elements, `rows` behind it.
std::string little_endian(const std::string& elements, const std::string& rows) {
  return "ply\nformat binary_little_endian 1.0\n" + elements + "end_header\n" + rows;
}

TEST(Ply, ReadsEveryEncodingBitForBit) {
  const PolygonMesh mesh = test::polygons(test::transformed(test::icosphere(2), 1e-7, test::some_rotation(), {1e3, -1, 1.0 / 3}));
  for (const PlyKind kind : {PlyKind::ascii, PlyKind::little_endian, PlyKind::big_endian})
    expect_same(read_ply(test::ply_file(mesh, kind)), mesh);
  for (const PlyKind kind : {PlyKind::ascii, PlyKind::little_endian, PlyKind::big_endian})
    expect_same(read_ply(test::ply_file(test::cube(), kind)), test::cube());
}

TEST(Ply, ReadsHeadersOfManyWriters) {
  expect_same(read_ply(with(ascii(), "format ascii", "comment before\nobj_info x\n\nformat ascii")), tetrahedron());
  expect_same(read_ply(with(ascii(), "element face", "comment # made by \\\nobj_info y\nelement face")), tetrahedron());
  expect_same(read_ply(with(ascii(), "uchar int vertex_indices", "uint8 uint32 vertex_index")), tetrahedron());
  std::string crlf = ascii();
  for (std::size_t at = crlf.find('\n'); at != std::string::npos; at = crlf.find('\n', at + 2)) crlf.replace(at, 1, "\r\n");
  expect_same(read_ply(crlf), tetrahedron());
  EXPECT_TRUE(is_ply(crlf));
  std::string binary_crlf = binary();
  for (std::size_t at = binary_crlf.find('\n'); at < binary_crlf.find("end_header") + 11; at = binary_crlf.find('\n', at + 2))
    binary_crlf.replace(at, 1, "\r\n");
  expect_same(read_ply(binary_crlf), tetrahedron());
}

TEST(Ply, AsciiRowsNeedNotBeLines) {
  std::string text = ascii();
  const std::size_t rows = text.find("end_header\n") + 11;
  for (std::size_t at = text.find('\n', rows); at != std::string::npos; at = text.find('\n', at + 1)) text[at] = ' ';
  expect_same(read_ply(text), tetrahedron());
}

TEST(Ply, SkipsOtherPropertiesAndElementsWhereverTheyStand) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement camera 1\nproperty list char float k\nproperty double f\nelement nothing 1000000000\n"
      "element vertex 4\nproperty list uchar int tags\nproperty float z\nproperty uchar red\nproperty float x\nproperty double y\n"
      "property list uchar float weights\nelement face 4\nproperty int material\nproperty list uint ushort vertex_indices\n"
      "property list uchar float texcoord\nelement edge 1\nproperty int a\nend_header\n"
      "3 1 2 3 0.5\n"
      "0 0 9 0 0 0\n2 7 7 0 9 1 0 1 0.5\n0 0 9 0 1 0\n0 1 9 0 0 0\n"
      "5 3 0 2 1 6 0 0 1 0 1 1\n5 3 0 1 3 0\n5 3 1 2 3 0\n5 3 2 0 3 0\n12\n";
  expect_same(read_ply(text), tetrahedron());
}

TEST(Ply, SkipsOtherPropertiesInBinaryRows) {
  std::string rows;
  append_number(rows, std::uint16_t{2});  // a list of two doubles in an element before
  append_number(rows, 1.0);
  append_number(rows, 2.0);
  const PolygonMesh mesh = tetrahedron();
  for (const std::int32_t f : {0, 1, 2, 3}) {
    append_number(rows, static_cast<std::int8_t>(3));
    for (const std::int32_t v : mesh.face(f)) append_number(rows, static_cast<std::uint8_t>(v));
    append_number(rows, 0.5F);
  }
  for (const std::int32_t v : {0, 1, 2, 3}) {
    append_number(rows, static_cast<std::int16_t>(mesh.vertices(v, 0)));
    append_number(rows, std::uint32_t{77});
    append_number(rows, static_cast<float>(mesh.vertices(v, 1)));
    append_number(rows, static_cast<std::int32_t>(mesh.vertices(v, 2)));
  }
  const std::string text = little_endian(
      "element extra 1\nproperty list ushort double numbers\nelement face 4\nproperty list char uchar vertex_index\nproperty float "
      "quality\n"
      "element vertex 4\nproperty short x\nproperty uint flags\nproperty float y\nproperty int z\n",
      rows);
  expect_same(read_ply(text), mesh);
  expect_same(read_ply(text + "what follows is not looked at"), mesh);
}

TEST(Ply, IsToldByItsFirstLine) {
  for (const char* text : {"ply\n", "ply\r\nformat"}) EXPECT_TRUE(is_ply(text)) << text;
  for (const char* text : {"", "ply", "plywood\n", "PLY\n", " ply\n", "#ply\n"}) EXPECT_FALSE(is_ply(text)) << text;
}

TEST(Ply, RefusesMalformedHeadersNamingTheLine) {
  struct Case {
    std::string text;
    const char* message;
  };
  for (const auto& [text, message] : std::vector<Case>{
           {"ply\n", "line 2: the file ends within the header"},
           {"ply\nelement vertex 3\n", "line 2: 'element' stands where 'format' should be"},
           {"ply\nformat utf8 1.0\n", "line 2: 'utf8' is not a PLY encoding"},
           {"ply\nformat ascii 1.0\nelement vertex 3\n", "the file ends within the header"},
           {with(ascii(), "element vertex 4", "element vertex four"), "line 3: 'four' is not the number of rows"},
           {with(ascii(), "element vertex 4", "element vertex"), "line 3: the line ends where the number of rows should be"},
           {with(ascii(), "element vertex 4", "element vertex -4"), "line 3: a count is negative"},
           {with(ascii(), "element vertex 4", "property int a\nelement vertex 4"), "line 3: a property stands before the first element"},
           {with(ascii(), "element face 4", "element vertex 4"), "line 7: there are two elements named 'vertex'"},
           {with(ascii(), "double x", "real x"), "line 4: 'real' is not a type of PLY"},
           {with(ascii(), "double x", "double"), "line 4: a property has no name"},
           {with(ascii(), "list uchar int", "list float int"), "line 8: the length of a list must be an integer"},
           {with(ascii(), "list uchar int", "list uchar float"), "vertex_indices must be integers"},
           {with(ascii(), "property double y\n", ""), "needs the properties x, y and z"},
           {with(ascii(), "double y", "list uchar double y"), "needs the properties x, y and z"},
           {with(ascii(), "element vertex", "element point"), "there is no element 'vertex'"},
           {with(ascii(), "element face", "element tristrips"), "there is no element 'face'"},
           {with(ascii(), "vertex_indices", "indices"), "needs the list vertex_indices"},
           {with(ascii(), "property double x", "properties x"), "line 4: 'properties' is not a statement of a PLY header"},
       })
    expect_refused(malformed, message, text);
}

TEST(Ply, RefusesMalformedRowsNamingThePlace) {
  struct Case {
    std::string text;
    const char* message;
  };
  std::string with_nan = binary();
  const std::size_t rows = with_nan.find("end_header\n") + 11;
  std::string nan;
  append_number(nan, std::numeric_limits<double>::quiet_NaN());
  with_nan.replace(rows + 24, 8, nan);
  const std::string place_of_nan = "byte " + std::to_string(rows + 32) + ": a coordinate is not finite";
  std::string out_of_range = binary();
  out_of_range[out_of_range.size() - 4] = 4;
  std::string negative_index = binary();
  for (std::size_t i = 1; i <= 4; ++i) negative_index[negative_index.size() - i] = '\xFF';
  std::string two_corners = binary();
  two_corners[rows + 96] = 2;
  for (const auto& [text, message] : std::vector<Case>{
           {with(ascii(), "\n0 1 0\n", "\n0 zero 0\n"), "line 12: 'zero' is not a coordinate"},
           {with(ascii(), "\n0 1 0\n", "\n0 nan 0\n"), "line 12: a coordinate is not finite"},
           {with(ascii(), "3 0 2 1", "3 0 2 4"), "line 14: vertex index 4 is not in 0 to 3"},
           {with(ascii(), "3 0 2 1", "3 0 2 -1"), "line 14: vertex index -1 is not in 0 to 3"},
           {with(ascii(), "3 0 2 1", "2 0 2 1"), "line 14: a face has 2 corners"},
           {with(ascii(), "3 0 2 1", "-3 0 2 1"), "line 14: a face has -3 corners"},
           {with(ascii(), "3 2 0 3", "9 2 0 3"), "line 18: the file ends where a vertex index should be"},
           {with_nan, place_of_nan.c_str()},
           {out_of_range, "vertex index 4 is not in 0 to 3"},
           {negative_index, "vertex index -1 is not in 0 to 3"},
           {two_corners, "a face has 2 corners"},
       })
    expect_refused(malformed, message, text);
}

TEST(Ply, ChecksCountsAgainstTheBytesBeforeItAllocates) {
  for (const std::string count : {"30", "1000", "4000000000", "9223372036854775807"}) {
    expect_refused(malformed, "the file is too short for " + count + " rows of element 'vertex'",
                   with(binary(), "vertex 4", "vertex " + count));
    expect_refused(malformed, "the file is too short for " + count + " rows of element 'vertex'",
                   with(ascii(), "vertex 4", "vertex " + count));
    expect_refused(malformed, "the file is too short for " + count + " rows of element 'face'", with(ascii(), "face 4", "face " + count));
  }
  for (const std::string count : {"53", "9223372036854775807"})
    expect_refused(malformed, "the file is too short for " + count + " rows of element 'face'", with(binary(), "face 4", "face " + count));
  expect_refused(malformed, "too large", with(binary(), "vertex 4", "vertex 9223372036854775808"));
}

TEST(Ply, ChecksListsAgainstTheBytesBeforeItAllocates) {
  std::string rows(96, '\0');
  append_number(rows, std::uint32_t{4000000000U});
  rows += std::string(64, '\0');
  const std::string vertex = "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n";
  expect_refused(ErrorCode::too_many_vertices, "the faces have more than 3600000 corners",
                 little_endian(vertex + "element face 1\nproperty list uint int vertex_indices\n", rows));
  expect_refused(
      malformed, "the file ends within a list",
      little_endian(vertex + "element other 1\nproperty list uint double bomb\nelement face 1\nproperty list uchar int vertex_indices\n",
                    rows));
  expect_refused(
      malformed, "the length of a list is negative",
      little_endian(vertex + "element other 1\nproperty list int double bomb\nelement face 1\nproperty list uchar int vertex_indices\n",
                    rows));
  std::string many_elements;
  for (int i = 0; i <= 100; ++i) many_elements += "element e" + std::to_string(i) + " 0\n";
  expect_refused(malformed, "there are more than 100 elements", little_endian(many_elements, ""));
}

TEST(Ply, KeepsToTheLimits) {
  for (const std::string& text : {ascii(), binary()}) {
    EXPECT_EQ(test::read(text, "", {.max_vertices = 4}).vertex_count(), 4);
    expect_refused(ErrorCode::too_many_vertices, "has 4 vertices; the limit is 3", text, "", {.max_vertices = 3});
  }
  PolygonMesh many = tetrahedron();
  for (int i = 0; i < 13; ++i) {
    many.indices.insert(many.indices.end(), {0, 1, 2});
    many.offsets.push_back(many.offsets.back() + 3);
  }
  for (const PlyKind kind : {PlyKind::ascii, PlyKind::big_endian})
    expect_refused(ErrorCode::too_many_vertices, "the faces have more than 48 corners", test::ply_file(many, kind), "",
                   {.max_vertices = 4});
}

TEST(Ply, RefusesFilesWithoutVerticesOrFaces) {
  expect_refused(ErrorCode::degenerate, "no vertices or no faces", with(ascii(), "face 4", "face 0"));
  expect_refused(ErrorCode::degenerate, "no vertices or no faces", with(binary(), "vertex 4", "vertex 0"));
}

}  // namespace
}  // namespace spherematch
