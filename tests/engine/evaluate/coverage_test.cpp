#include "engine/evaluate/coverage.h"

#include <gtest/gtest.h>

#include "tests/engine/evaluate/surfaces.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

TEST(Coverage, TheIdentityCoversAll) {
  const TriMesh body = test::creature(3);
  const Surface surface = test::surface_of(body);
  const Coverage all = measure_coverage(test::identity_map(body), surface, surface);
  EXPECT_NEAR(all.area, 1, 1e-12);
  EXPECT_EQ(all.vertices, 1);
}

TEST(Coverage, ACoarseMeshCoversAFineOneWhereItsFacesLieOverIt) {
  const TriMesh coarse = test::icosphere(2), fine = test::icosphere(4);  // whose first vertices are those of the coarse one
  const Surface source = test::surface_of(coarse), target = test::surface_of(fine);
  const Coverage onto_fine = measure_coverage(test::vertex_map(test::numbers_to(coarse.vertex_count()), fine), source, target);
  EXPECT_GT(onto_fine.area, 0.999);
  EXPECT_NEAR(onto_fine.vertices, static_cast<double>(coarse.vertex_count()) / static_cast<double>(fine.vertex_count()), 1e-12);
}

TEST(Coverage, AFoldedMapCoversOneHalf) {
  const TriMesh sphere = test::icosphere(4);
  const Surface surface = test::surface_of(sphere);
  std::vector<std::int32_t> targets;
  for (const auto& vertex : sphere.vertices.rowwise()) {
    const Eigen::RowVector3d image(vertex[0], vertex[1], std::abs(vertex[2]));
    Eigen::Index nearest = 0;
    (sphere.vertices.rowwise() - image).rowwise().squaredNorm().minCoeff(&nearest);
    targets.push_back(static_cast<std::int32_t>(nearest));
  }
  const Coverage half = measure_coverage(test::vertex_map(targets, sphere), surface, surface);
  EXPECT_NEAR(half.area, 0.5, 0.03);
  EXPECT_NEAR(half.vertices, 0.5, 0.03);
}

TEST(Coverage, APointCoversNothing) {
  const TriMesh sphere = test::icosphere(2);
  const Surface surface = test::surface_of(sphere);
  const std::vector<std::int32_t> one(static_cast<std::size_t>(sphere.vertex_count()), 7);
  EXPECT_EQ(measure_coverage(test::vertex_map(one, sphere), surface, surface).area, 0);
  const std::vector<std::int32_t> none(one.size(), -1);
  EXPECT_EQ(measure_coverage(test::vertex_map(none, sphere), surface, surface).vertices, 0);
}

TEST(Coverage, FacesThatAreNotUploadedDoNotCount) {
  TriMesh open = test::icosphere(3);
  open = test::without_faces(open, std::vector<std::int32_t>{0, 1, 2, 3});
  const Surface surface = test::surface_of(open);
  ASSERT_GT(surface.report.filled_loops, 0);
  EXPECT_NEAR(measure_coverage(test::identity_map(open), surface, surface).area, 1, 1e-12);
}

TEST(Coverage, StopsWhenAsked) {
  const TriMesh sphere = test::icosphere(2);
  const Surface surface = test::surface_of(sphere);
  std::stop_source stop;
  stop.request_stop();
  test::expect_refusal(ErrorCode::cancelled, [&] {
    (void)measure_coverage(test::identity_map(sphere), surface, surface, {.report = {}, .stop = stop.get_token()});
  });
}

}  // namespace
}  // namespace spherematch
