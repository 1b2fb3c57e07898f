#include "engine/evaluate/continuity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/evaluate/surface_distance.h"
#include "tests/engine/evaluate/surfaces.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

TEST(Continuity, AnIsometryStretchesNothingAtAnySize) {
  const TriMesh body = test::creature(3);
  const TriMesh larger = test::transformed(body, 30, test::some_rotation(), {1, 2, 3});
  const Continuity result = measure_continuity(test::identity_map(body), test::surface_of(body), test::surface_of(larger));
  EXPECT_EQ(result.edges, 3 * body.vertex_count() - 6);
  EXPECT_EQ(result.torn, 0);
  EXPECT_LT(result.edge_distortion, 1e-12);
  EXPECT_NEAR(result.stretch_median, 1, 1e-12);
  EXPECT_NEAR(result.stretch_p95, 1, 1e-12);
  EXPECT_NEAR(result.stretch_max, 1, 1e-12);
  EXPECT_NEAR(result.dirichlet, 1, 1e-12);
  EXPECT_EQ(result.turned, 0);
}

TEST(Continuity, TheEnergyOfALinearMapOfTheSphereIsKnown) {
  // Half the integral of tr(A^T A) - |A n|^2 over the unit sphere is 4 pi / 3 |A|^2.
  const Eigen::Vector3d axes(1, 2, 0.5);
  const Surface target = test::surface_of(test::ellipsoid(4, axes));
  const TriMesh sphere = test::icosphere(4);
  const Continuity result = measure_continuity(test::identity_map(sphere), test::surface_of(sphere), target);
  const double area = unit_length(target) * unit_length(target);
  EXPECT_NEAR(result.dirichlet / (4 * std::numbers::pi / 3 * axes.squaredNorm() / area), 1, 0.01);
  EXPECT_GT(result.dirichlet, 1.05) << "an energy is at least the area, and equal to it for conformal maps alone";
  EXPECT_EQ(result.turned, 0);
  EXPECT_EQ(result.torn, 0);
}

TEST(Continuity, TwoExchangedVerticesTearTheEdgesRoundThem) {
  const TriMesh sphere = test::icosphere(3);
  Eigen::Index north = 0, south = 0;
  sphere.vertices.col(2).maxCoeff(&north);
  sphere.vertices.col(2).minCoeff(&south);
  std::vector<std::int32_t> targets = test::numbers_to(sphere.vertex_count());
  std::swap(targets[static_cast<std::size_t>(north)], targets[static_cast<std::size_t>(south)]);
  int edges = 0;  // round either, as many as faces
  for (const std::int32_t corner : sphere.faces.reshaped()) edges += corner == north || corner == south ? 1 : 0;
  const Surface surface = test::surface_of(sphere);
  const Continuity result = measure_continuity(test::vertex_map(targets, sphere), surface, surface);
  EXPECT_EQ(result.torn, edges);
  // All the way from pole to pole, with edges of about a twelfth of that.
  EXPECT_GT(result.stretch_max, 8);
  EXPECT_NEAR(result.stretch_median, 1, 1e-12);
}

TEST(Continuity, TurnedFacesAreTheFewerOnes) {
  const TriMesh sphere = test::icosphere(3);
  const Surface surface = test::surface_of(sphere);
  // The mirror image turns all faces, which is no fold.
  std::vector<std::int32_t> mirrored;
  for (const auto& vertex : sphere.vertices.rowwise()) {
    const Eigen::RowVector3d image(vertex[0], vertex[1], -vertex[2]);
    Eigen::Index nearest = 0;
    ASSERT_LT((sphere.vertices.rowwise() - image).rowwise().squaredNorm().minCoeff(&nearest), 1e-20);
    mirrored.push_back(static_cast<std::int32_t>(nearest));
  }
  EXPECT_EQ(measure_continuity(test::vertex_map(mirrored, sphere), surface, surface).turned, 0);
  // A vertex that is drawn beyond the ring of its neighbours turns some of its faces.
  std::vector<std::int32_t> targets = test::numbers_to(sphere.vertex_count());
  Eigen::Index beyond = 0;
  const Eigen::RowVector3d place = sphere.vertices.row(0);
  const double edge = (sphere.vertices.row(sphere.faces(0, 0)) - sphere.vertices.row(sphere.faces(0, 1))).norm();
  ((sphere.vertices.rowwise() - place).rowwise().norm().array() - 2.5 * edge).abs().minCoeff(&beyond);
  targets[0] = static_cast<std::int32_t>(beyond);
  const double turned = measure_continuity(test::vertex_map(targets, sphere), surface, surface).turned;
  EXPECT_GT(turned, 1.0 / static_cast<double>(sphere.face_count()) / 2);
  EXPECT_LT(turned, 6.0 / static_cast<double>(sphere.face_count()) * 2);
}

TEST(Continuity, DroppedVerticesAndOtherSizes) {
  const TriMesh sphere = test::icosphere(2);
  const Surface surface = test::surface_of(sphere);
  std::vector<std::int32_t> targets = test::numbers_to(sphere.vertex_count());
  targets[0] = -1;
  const Continuity result = measure_continuity(test::vertex_map(targets, sphere), surface, surface);
  EXPECT_EQ(result.edges, 3 * sphere.vertex_count() - 6 - 5);
  EXPECT_NEAR(result.dirichlet, 1, 1e-12);
  const Continuity nothing = measure_continuity(test::vertex_map(std::vector<std::int32_t>(targets.size(), -1), sphere), surface, surface);
  EXPECT_EQ(nothing.edges, 0);
  EXPECT_EQ(nothing.dirichlet, 0);
  targets.pop_back();
  test::expect_refusal(ErrorCode::invalid_parameter,
                       [&] { (void)measure_continuity(test::vertex_map(targets, sphere), surface, surface); });
}

}  // namespace
}  // namespace spherematch
