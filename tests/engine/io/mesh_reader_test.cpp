#include "engine/io/mesh_reader.h"

#include <gtest/gtest.h>

#include <string>

#include "engine/io/off.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::expect_refusal;

PolygonMesh read(std::string_view text, std::string_view name) { return read_mesh(std::as_bytes(std::span(text)), name); }

TEST(MeshReader, RecognisesContentWhateverTheName) {
  const std::string text = write_off(test::tetrahedron());
  for (const char* name : {"", "a.off", "a.ply", "mesh"}) EXPECT_EQ(read(text, name).face_count(), 4) << name;
}

TEST(MeshReader, FallsBackToTheName) {
  const std::string text = write_off(test::tetrahedron()).substr(4);  // without the keyword
  for (const char* name : {"a.off", "A.OFF", "dir/a.Off"}) EXPECT_EQ(read(text, name).face_count(), 4) << name;
  for (const char* name : {"", "a.ply", "off", ".of", "a.off.gz"})
    expect_refusal(ErrorCode::unsupported_format, [&] { (void)read(text, name); });
}

TEST(MeshReader, RefusesNothingAndTheUnknown) {
  expect_refusal(ErrorCode::malformed_mesh, [] { (void)read("", "a.off"); });
  expect_refusal(ErrorCode::unsupported_format, [] { (void)read(std::string_view("\0\x01\xFF", 3), "a.bin"); });
}

TEST(MeshReader, PassesLimitsOn) {
  const std::string text = write_off(test::tetrahedron());
  expect_refusal(ErrorCode::too_many_vertices, [&] { (void)read_mesh(std::as_bytes(std::span(text)), "", {.max_vertices = 3}); });
}

}  // namespace
}  // namespace spherematch
