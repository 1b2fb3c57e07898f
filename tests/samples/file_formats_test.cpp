#include "samples/file_formats.h"

#include <gtest/gtest.h>

#include <span>

#include "engine/io/mesh_reader.h"
#include "tests/samples/meshes.h"

namespace spherematch::samples {
namespace {

TEST(SamplesFileFormats, DecimalsAreShortAndWithoutNegativeZero) {
  EXPECT_EQ(decimal(12), "12");
  EXPECT_EQ(decimal(-12.3), "-12.3");
  EXPECT_EQ(decimal(0.054), "0.05");
  EXPECT_EQ(decimal(-0.999), "-1");
  EXPECT_EQ(decimal(-0.05), "-0.05");
  EXPECT_EQ(decimal(-0.001), "0");
  EXPECT_EQ(decimal(-0.0), "0");
}

TEST(SamplesFileFormats, OffAndGlbHoldTheSameMesh) {
  Mesh mesh = sphere_mesh(2);
  for (Vec3& p : mesh.vertices) p = 37 * p;
  const auto read = [](const std::string& bytes) { return read_mesh(std::as_bytes(std::span(bytes)), ""); };
  const PolygonMesh off = read(off_file(mesh)), glb = read(glb_file(mesh, "ball"));
  ASSERT_EQ(off.vertex_count(), static_cast<int>(mesh.vertices.size()));
  ASSERT_EQ(off.face_count(), static_cast<int>(mesh.triangles.size()));
  EXPECT_EQ(off.indices, glb.indices);
  EXPECT_EQ(off.vertices.cast<float>(), glb.vertices.cast<float>());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(off.indices[3 * t + k], mesh.triangles[t][k]);
  EXPECT_NEAR(off.vertices(7, 1), mesh.vertices[7].y, 0.005001);
}

TEST(SamplesFileFormats, LandmarksCountFromOne) { EXPECT_EQ(vts_file({0, 41, 7}), "1\n42\n8\n"); }

}  // namespace
}  // namespace spherematch::samples
