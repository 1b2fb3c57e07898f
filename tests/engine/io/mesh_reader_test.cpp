#include "engine/io/mesh_reader.h"

#include <gtest/gtest.h>

#include <string>

#include "engine/io/off.h"
#include "tests/engine/io/reading.h"
#include "tests/support/mesh_files.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

using test::expect_refused;
using test::expect_same;
using test::read;

TEST(MeshReader, TheSameMeshInEveryFormatReadsTheSame) {
  const TriMesh creature = test::creature(3);
  for (const TriMesh& mesh : {test::tetrahedron(), creature, test::transformed(creature, 1e-5, test::some_rotation(), {1e-3, -7, 0})}) {
    const PolygonMesh expected = test::fit_for_every_format(mesh);
    for (const auto& [name, bytes] : test::in_every_format(expected)) expect_same(read(bytes), expected, name);
  }
}

TEST(MeshReader, RecognisesContentWhateverTheName) {
  const PolygonMesh expected = test::fit_for_every_format(test::tetrahedron());
  for (const auto& [format, bytes] : test::in_every_format(expected))
    for (const char* name : {"", "a.off", "a.OBJ", "a.ply", "a.stl", "a.gltf", "a.glb", "mesh", "a.fbx"})
      expect_same(read(bytes, name), expected, format + " as " + name);
}

TEST(MeshReader, FallsBackToTheName) {
  const std::string text = write_off(test::tetrahedron()).substr(4);  // without the keyword
  for (const char* name : {"a.off", "A.OFF", "dir/a.Off"}) EXPECT_EQ(read(text, name).face_count(), 4) << name;
  for (const char* name : {"", "off", ".of", "a.off.gz"})
    expect_refused(ErrorCode::unsupported_format, "not recognised; OFF, OBJ, PLY, STL, glTF and GLB are supported", text, name);
  for (const char* name : {"a.ply", "a.stl", "a.gltf", "a.glb"}) expect_refused(ErrorCode::malformed_mesh, "", text, name);
  expect_refused(ErrorCode::degenerate, "no vertices or no faces", text, "a.obj");
}

TEST(MeshReader, NamesTheFormatByContentThenByName) {
  const auto named = [](const std::string& bytes, std::string_view name) { return mesh_format_of(std::as_bytes(std::span(bytes)), name); };
  const PolygonMesh mesh = test::fit_for_every_format(test::tetrahedron());
  for (const auto& [format, bytes] : test::in_every_format(mesh)) {
    const std::string_view found = named(bytes, "a.fbx");
    EXPECT_FALSE(found.empty()) << format;
    EXPECT_TRUE(format.ends_with(found)) << format << " was taken for " << found;
  }
  const std::string plain = write_off(test::tetrahedron()).substr(4);
  EXPECT_EQ(named(plain, "dir/A.OFF"), "off");
  EXPECT_EQ(named(plain, ".gltf"), "gltf");
  EXPECT_EQ(named(plain, ".glb"), "glb");
  EXPECT_EQ(named(plain, "a"), "");
  EXPECT_EQ(named("PK\x03\x04", "a.off"), "");
  EXPECT_EQ(named("", ""), "");
}

TEST(MeshReader, RefusesNothingAndTheUnknown) {
  expect_refused(ErrorCode::malformed_mesh, "the mesh file is empty", "", "a.off");
  for (const std::string_view bytes :
       {std::string_view("\0\x01\xFF", 3), std::string_view("hello"), std::string_view("\n\n"), std::string_view("name=x&file=y")})
    expect_refused(ErrorCode::unsupported_format, "not recognised", bytes, "a.bin");
}

TEST(MeshReader, NamesWhatPeopleUploadByMistake) {
  for (const auto& [bytes, message] :
       std::vector<std::pair<std::string, std::string>>{{"\x1F\x8B\x08", "the file is compressed with gzip; upload it unpacked"},
                                                        {"PK\x03\x04", "the file is a zip archive"},
                                                        {"Kaydara FBX Binary  ", "the file is FBX. OFF, OBJ, PLY"},
                                                        {"<!DOCTYPE html>", "the file is XML or HTML"},
                                                        {"# vtk DataFile Version 3.0\n", "the file is VTK"},
                                                        {"\xFF\xFEO", "the file is text in UTF-16"}})
    for (const char* name : {"", "a.off", "a.stl"}) expect_refused(ErrorCode::unsupported_format, message, bytes, name);
}

TEST(MeshReader, KeepsToTheLimitsInEveryFormat) {
  const PolygonMesh mesh = test::fit_for_every_format(test::icosphere(1));
  for (const auto& [name, bytes] : test::in_every_format(mesh)) {
    EXPECT_EQ(read(bytes, name, {.max_vertices = 42}).vertex_count(), 42) << name;
    expect_refused(ErrorCode::too_many_vertices, "has 42 vertices; the limit is 41", bytes, name, {.max_vertices = 41});
  }
}

}  // namespace
}  // namespace spherematch
