#include "samples/holes.h"

#include <gtest/gtest.h>

#include "tests/samples/meshes.h"

namespace spherematch::samples {
namespace {

TEST(SamplesHoles, TrianglesInTheBallAndUnusedVerticesGo) {
  const Mesh mesh = sphere_mesh(3);
  const std::vector<Ball> balls{{{0, 0, 1}, 0.4}};
  const Cut cut = cut_holes(mesh, balls);
  std::size_t touched = 0;
  for (const Triangle& t : mesh.triangles) {
    bool inside = false;
    for (const int v : t) inside = inside || is_in(balls, mesh.vertices[static_cast<std::size_t>(v)]);
    touched += inside ? 1 : 0;
  }
  EXPECT_GT(touched, 10u);
  EXPECT_EQ(cut.triangles.size(), mesh.triangles.size() - touched);
  for (std::size_t i = 0; i < cut.kept.size(); ++i) {
    const auto v = static_cast<std::size_t>(cut.kept[i]);
    EXPECT_EQ(cut.new_number[v], static_cast<int>(i));
    EXPECT_FALSE(is_in(balls, mesh.vertices[v]));
  }
  std::vector<bool> used(cut.kept.size(), false);
  for (const Triangle& t : cut.triangles)
    for (const int v : t) used.at(static_cast<std::size_t>(v)) = true;
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
}

TEST(SamplesHoles, NothingGoesWithoutBalls) {
  const Mesh mesh = sphere_mesh(1);
  EXPECT_EQ(cut_holes(mesh, {}).triangles, mesh.triangles);
}

}  // namespace
}  // namespace spherematch::samples
