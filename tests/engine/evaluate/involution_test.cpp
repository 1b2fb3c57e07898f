#include "engine/evaluate/involution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/mesh/repair.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

Surface surface_of(const TriMesh& mesh) { return repair(test::polygons(mesh), RepairMode::fill); }

/// Vertex i goes to vertex to(i).
template <typename Image>
Correspondence vertex_map(std::int32_t count, const Image& to) {
  Correspondence map;
  map.corners.setZero(count, 3);
  map.bary.setZero(count, 3);
  for (std::int32_t i = 0; i < count; ++i) {
    map.vertex.push_back(to(i));
    map.corners.row(i).setConstant(to(i));
    map.bary(i, 0) = 1;
  }
  return map;
}

/// The vertex at the mirror image of a vertex.
std::int32_t reflected(const TriMesh& mesh, std::int32_t vertex) {
  std::int32_t best = 0;
  (mesh.vertices.rowwise() - mesh.vertices.row(vertex).cwiseProduct(Eigen::RowVector3d(1, -1, 1))).rowwise().squaredNorm().minCoeff(&best);
  return best;
}

TEST(InvolutionResidual, OfAReflectionIsZero) {
  const TriMesh body = test::ellipsoid(2, {1, 1.4, 1.9});
  const auto count = static_cast<std::int32_t>(body.vertex_count());
  const InvolutionResidual residual = involution_residual(vertex_map(count, [&](auto i) { return reflected(body, i); }), surface_of(body));
  EXPECT_EQ(residual.max, 0);
  EXPECT_EQ(residual.mean, 0);
}

TEST(InvolutionResidual, IsTheDistanceAfterTwoSteps) {
  // Round the corners 0 to 2 of a regular tetrahedron: twice that moves three corners along an edge and leaves one. All count alike.
  TriMesh mesh = test::tetrahedron();
  mesh.vertices << 1, 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1;
  const double edge = std::sqrt(8.0), unit = std::sqrt(std::sqrt(3.0) * edge * edge);
  const Correspondence turn = vertex_map(4, [](std::int32_t i) { return i < 3 ? (i + 1) % 3 : 3; });
  const InvolutionResidual residual = involution_residual(turn, surface_of(mesh));
  EXPECT_NEAR(residual.max, edge / unit, 1e-12);
  EXPECT_NEAR(residual.mean, 0.75 * edge / unit, 1e-12);
  mesh.vertices *= 7;
  EXPECT_NEAR(involution_residual(turn, surface_of(mesh)).mean, residual.mean, 1e-12);
}

TEST(InvolutionResidual, CarriesPointsWithinFacesLinearly) {
  TriMesh mesh = test::tetrahedron();
  mesh.vertices << 1, 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1;
  const double edge = std::sqrt(8.0), unit = std::sqrt(std::sqrt(3.0) * edge * edge);
  // Vertex 0 goes to the middle between 1 and 2, which both go to 0; so does 3. 1 and 2 thereby end at the middle, 3 away from itself.
  Correspondence map = vertex_map(4, [](std::int32_t) { return 0; });
  map.corners.row(0) << 1, 2, 3;
  map.bary.row(0) << 0.5F, 0.5F, 0;
  const double half = edge / 2, height = edge * std::sqrt(3.0) / 2;
  const InvolutionResidual residual = involution_residual(map, surface_of(mesh));
  EXPECT_NEAR(residual.mean, (0 + half + half + height) / 4 / unit, 1e-12);
  EXPECT_NEAR(residual.max, height / unit, 1e-12);
}

TEST(InvolutionResidual, LeavesOutWhatHasNoImage) {
  TriMesh mesh = test::tetrahedron();
  test::resize_vertices(mesh, 5);
  const Surface surface = surface_of(mesh);
  ASSERT_EQ(surface.surface_vertex[4], -1);
  Correspondence map = vertex_map(5, [](std::int32_t i) { return i; });
  const auto drop = [&map](Eigen::Index vertex) {
    map.vertex[static_cast<std::size_t>(vertex)] = -1;
    map.corners.row(vertex).setConstant(-1);
    map.bary.row(vertex).setZero();
  };
  drop(4);
  EXPECT_EQ(involution_residual(map, surface).max, 0);
  for (Eigen::Index i = 0; i < 4; ++i) drop(i);
  EXPECT_EQ(involution_residual(map, surface).mean, 0) << "nothing is left";
}

}  // namespace
}  // namespace spherematch
