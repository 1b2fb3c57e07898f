#include "engine/mesh/spatial_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "tests/support/meshes.h"

namespace spherematch {
namespace {

/// Mean distance between the numbers of the ends of an edge.
double mean_jump(const Triangles& faces) {
  double sum = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) sum += std::abs(faces(f, k) - faces(f, (k + 1) % 3));
  return sum / static_cast<double>(faces.size());
}

TEST(SpatialOrder, IsARenumberingThatBringsNeighboursTogether) {
  const TriMesh body = test::creature(4);
  const TriMesh mesh = test::renumbered(body, test::shuffled(static_cast<std::int32_t>(body.vertex_count()), 1));
  const std::vector<std::int32_t> order = spatial_order(mesh.vertices);
  const TriMesh ordered = renumbered(mesh, order);
  std::vector<std::int32_t> sorted = order, all(sorted.size());
  std::iota(all.begin(), all.end(), 0);
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, all);

  // The same faces, corner by corner.
  const auto rows = [](const Triangles& faces, const auto& number) {
    std::vector<std::vector<std::int32_t>> result;
    for (Eigen::Index f = 0; f < faces.rows(); ++f) result.push_back({number(faces(f, 0)), number(faces(f, 1)), number(faces(f, 2))});
    std::sort(result.begin(), result.end());
    return result;
  };
  EXPECT_EQ(rows(ordered.faces, [&](std::int32_t v) { return order[static_cast<std::size_t>(v)]; }),
            rows(mesh.faces, [](std::int32_t v) { return v; }));
  EXPECT_TRUE(ordered.vertices == mesh.vertices(order, Eigen::all));

  // Of 2562 vertices. Measured: 854 and 89.
  EXPECT_GT(mean_jump(mesh.faces), 700);
  EXPECT_LT(mean_jump(ordered.faces), 180);
}

TEST(SpatialOrder, TakesVerticesThatCoincide) {
  TriMesh mesh = test::tetrahedron();
  mesh.vertices.setConstant(3);
  const std::vector<std::int32_t> order = spatial_order(mesh.vertices);
  const TriMesh ordered = renumbered(mesh, order);
  EXPECT_EQ(order, (std::vector<std::int32_t>{0, 1, 2, 3}));
  EXPECT_EQ(ordered.faces.rows(), 4);
  EXPECT_EQ(ordered.faces.row(0).minCoeff(), 0);
}

}  // namespace
}  // namespace spherematch
