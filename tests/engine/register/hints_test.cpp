#include "engine/register/hints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "engine/mesh/repair.h"
#include "engine/sphere/orientation.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

Surface surface_of(const TriMesh& mesh) { return repair(test::polygons(mesh), RepairMode::fill); }

PlacedHint hint_between(std::int32_t source, std::int32_t target) {
  return {{{source, source, source}, {1, 0, 0}}, {{target, target, target}, {1, 0, 0}}};
}

double angle(const Points& a, std::int32_t i, const Points& b, std::int32_t j) { return std::acos(std::min(1.0, a.row(i).dot(b.row(j)))); }

TEST(Hints, NameVerticesOfTheUploads) {
  // A tetrahedron beside a larger body is dropped; its vertices come first.
  const TriMesh both =
      test::joined(test::transformed(test::tetrahedron(), 0.01, Eigen::Matrix3d::Identity(), {9, 9, 9}), test::icosphere(1));
  const Surface source = surface_of(both), target = surface_of(test::icosphere(1));
  const auto placed = place_hints(source, target, {{5, 7}});
  ASSERT_EQ(placed.size(), 1U);
  EXPECT_LT((placed[0].source.of(source.mesh.vertices) - both.vertices.row(5).transpose()).norm(), 1e-15);
  EXPECT_LT((placed[0].target.of(target.mesh.vertices) - target.mesh.vertices.row(7).transpose()).norm(), 1e-15);

  const auto message = [&](const Hint& hint) -> std::string {
    try {
      (void)place_hints(source, target, {{5, 7}, hint});
    } catch (const EngineError& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_parameter);
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message({46, 7}), "hints: vertex 46 of the source does not exist; it has 46 vertices, numbered from 0");
  EXPECT_EQ(message({5, 42}), "hints: vertex 42 of the target does not exist; it has 42 vertices, numbered from 0");
  EXPECT_EQ(message({5, -1}), "hints: vertex -1 of the target does not exist; it has 42 vertices, numbered from 0");
  EXPECT_EQ(message({2, 7}), "hints: vertex 2 of the source was dropped when the mesh was repaired");
}

TEST(Hints, DetermineARotation) {
  const Points source = test::icosphere(3).vertices, target = source * test::some_rotation().transpose();
  const std::vector<PlacedHint> two{hint_between(3, 3), hint_between(100, 100)};
  for (std::vector<PlacedHint> hints : {two, std::vector<PlacedHint>{two[0], two[1], hint_between(200, 200), hint_between(300, 300)}}) {
    const auto rotation = rotation_from_hints(directions(hints, source, target));
    ASSERT_TRUE(rotation.has_value());
    EXPECT_LT((*rotation - test::some_rotation()).norm(), 1e-12);
  }
}

TEST(Hints, OneWrongAmongFiveHardlyTurnsTheRotation) {
  const Points source = test::icosphere(3).vertices, target = source * test::some_rotation().transpose();
  std::vector<PlacedHint> hints;
  for (const std::int32_t v : {3, 100, 200, 300}) hints.push_back(hint_between(v, v));
  std::int32_t opposite = 0;
  ((target.rowwise() + target.row(50)).rowwise().squaredNorm()).minCoeff(&opposite);
  hints.push_back(hint_between(50, opposite));
  const auto rotation = rotation_from_hints(directions(hints, source, target));
  ASSERT_TRUE(rotation.has_value());
  EXPECT_LT((*rotation - test::some_rotation()).norm(), 0.1);  // least squares: 0.8
}

TEST(Hints, OnOneAxisDetermineNothing) {
  const Points sphere = test::icosphere(2).vertices;
  std::int32_t opposite = 0;
  ((sphere.rowwise() + sphere.row(7)).rowwise().squaredNorm()).minCoeff(&opposite);
  EXPECT_FALSE(rotation_from_hints(directions({}, sphere, sphere)).has_value());
  EXPECT_FALSE(rotation_from_hints(directions({hint_between(7, 9)}, sphere, sphere)).has_value());
  EXPECT_FALSE(rotation_from_hints(directions({hint_between(7, 7), hint_between(opposite, opposite)}, sphere, sphere)).has_value());
}

class PullTogether : public ::testing::Test {
 protected:
  const TriMesh mesh_ = test::icosphere(3);
  /// The vertex whose angle to `vertex` is nearest to the wanted one, in radians.
  [[nodiscard]] std::int32_t near_to(std::int32_t vertex, double wanted) const {
    std::int32_t best = 0;
    (mesh_.vertices * mesh_.vertices.row(vertex).transpose()).array().operator-(std::cos(wanted)).abs().minCoeff(&best);
    return best;
  }
  struct Pulled {
    Points source, target;
  };
  [[nodiscard]] Pulled pulled(const std::vector<PlacedHint>& hints, double width, bool exchanged = false) const {
    const Eigen::Matrix3d none = Eigen::Matrix3d::Identity();
    const auto signals = std::make_shared<const MeshSignals>(mesh_.vertices, mesh_.faces, Eigen::MatrixXd(mesh_.vertex_count(), 0));
    MeshFlowSide source(signals, none), target(signals, none);
    HintDirections places = directions(hints, mesh_.vertices, mesh_.vertices);
    if (exchanged) std::swap(places.source, places.target);
    pull_together(source, target, places, width);
    return {source.warp().forward(mesh_.vertices), target.warp().forward(mesh_.vertices)};
  }
};

TEST_F(PullTogether, BringsHintsNearerWithoutFolding) {
  const std::vector<PlacedHint> hints{hint_between(10, near_to(10, 0.4)), hint_between(300, near_to(300, 0.3))};
  const auto [source, target] = pulled(hints, 1.0);
  for (const PlacedHint& hint : hints) {
    const std::int32_t i = hint.source.vertices[0], j = hint.target.vertices[0];
    EXPECT_LT(angle(source, i, target, j), 0.25 * angle(mesh_.vertices, i, mesh_.vertices, j));
  }
  EXPECT_LT((source.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-14);
  EXPECT_TRUE(flipped_faces(source, mesh_.faces).empty());
  EXPECT_TRUE(flipped_faces(target, mesh_.faces).empty());
  const auto [exchanged_source, exchanged_target] = pulled(hints, 1.0, true);
  EXPECT_LT((exchanged_source - target).norm(), 1e-12);
  EXPECT_LT((exchanged_target - source).norm(), 1e-12);
}

TEST_F(PullTogether, LeavesHintsBeyondARightAngleAlone) {
  const auto [source, target] = pulled({hint_between(10, near_to(10, 2.0))}, 1.0);
  EXPECT_TRUE(source == mesh_.vertices);
  EXPECT_TRUE(target == mesh_.vertices);
}

}  // namespace
}  // namespace spherematch
