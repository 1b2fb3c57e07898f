// A shape matched with its own mirror image, against the symmetry that it was made with.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/engine.h"
#include "engine/evaluate/map_error.h"
#include "tests/support/meshes.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

/// A trunk with a head, a tail, and legs in pairs of which the front ones are longer: symmetric in y and in nothing else. An icosphere is
/// symmetric in y as well, so that every vertex has a partner.
TriMesh beast(int subdivisions) {
  TriMesh mesh = test::icosphere(subdivisions);
  const Eigen::Vector3d limbs[] = {{1, 0, 0.4}, {-1, 0, 0.1}, {0.6, 0.6, -0.6}, {0.6, -0.6, -0.6}, {-0.6, 0.5, -0.7}, {-0.6, -0.5, -0.7}};
  const double lengths[] = {0.9, 0.5, 1.1, 1.1, 0.8, 0.8};
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    const Eigen::Vector3d at = mesh.vertices.row(v);
    double radius = 1;
    for (std::size_t i = 0; i < 6; ++i) radius += lengths[i] * std::exp(-12 * (1 - at.dot(limbs[i].normalized())));
    mesh.vertices.row(v) *= radius;
  }
  return mesh;
}

/// A long flat body with a head, a bulge on the chest and a dent of the same shape in the back. Its left side is a little wider, so that to
/// the metric alone exchanging chest and back is hardly a worse symmetry than exchanging left and right.
TriMesh chest_and_back(int subdivisions) {
  TriMesh mesh = test::icosphere(subdivisions);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    const Eigen::RowVector3d at = mesh.vertices.row(v);
    const double x = at[0], y = at[1], z = at[2];
    const double bump = 0.22 * std::exp(-7 * ((x - 0.3) * (x - 0.3) + y * y)) * std::min(1.0, 3 * std::abs(z));
    mesh.vertices.row(v) << 2 * x + 0.6 * std::exp(-12 * (1 - x)), (y > 0 ? 1.06 : 1) * 1.1 * y, 0.55 * z + bump;
  }
  return mesh;
}

/// Twisted about x and bent about z: the left side in another pose than the right, with lengths nearly as they were.
TriMesh posed(TriMesh mesh) {
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    const double x = mesh.vertices(v, 0), y = mesh.vertices(v, 1), z = mesh.vertices(v, 2), twist = 0.15 * x, bend = 0.12 * x;
    const double u = std::cos(twist) * y - std::sin(twist) * z, w = std::sin(twist) * y + std::cos(twist) * z;
    mesh.vertices.row(v) << std::cos(bend) * x - std::sin(bend) * u, std::sin(bend) * x + std::cos(bend) * u, w;
  }
  return mesh;
}

class Symmetry : public ::testing::Test {
 protected:
  static MatchResult symmetry(const MatchShape& shape, int threads = 2) {
    MatchParameters parameters;
    parameters.orientation = Orientation::reverse;
    parameters.flow_times = {0.5, 0.25};
    return match(shape, shape, parameters, {}, threads);
  }
  static std::shared_ptr<const PreprocessedShape> shared(PreprocessedShape shape) {
    return std::make_shared<const PreprocessedShape>(std::move(shape));
  }
  static double quality(const MatchResult& result, const std::string& name) {
    const auto found = std::find_if(result.quality.begin(), result.quality.end(), [&](const auto& figure) { return figure.first == name; });
    EXPECT_NE(found, result.quality.end()) << name;
    return found == result.quality.end() ? std::nan("") : found->second;
  }
  [[nodiscard]] std::int32_t partner(std::int32_t vertex) const {
    std::int32_t best = 0;
    const Eigen::RowVector3d place = rest_.vertices.row(vertex).cwiseProduct(Eigen::RowVector3d(1, -1, 1));
    EXPECT_LT((rest_.vertices.rowwise() - place).rowwise().squaredNorm().minCoeff(&best), 1e-20);
    return best;
  }
  /// Along the surface, against the partner of each vertex.
  [[nodiscard]] double error(const MatchResult& result, const Surface& surface) const {
    std::vector<Landmark> truth;
    for (std::int32_t v = 0; v < surface.uploaded_vertices(); v += 7) truth.push_back({v, partner(v)});
    return geodesic_error(result.map, surface, truth).mean;
  }

  const TriMesh rest_ = beast(3);
};

TEST_F(Symmetry, OfABodyAtRestAndInAPose) {
  const std::pair<TriMesh, double> cases[] = {
      // The twist strains the body, which has nothing else to hold on to than its limbs: measured 0.048, and 0.03 where neither
      // eigenfunctions
      // are compared nor signals yield, which on scans of people and animals is the worse by 2 to 7 percent.
      {rest_, 0.03},
      {posed(rest_), 0.055},
      {test::transformed(posed(rest_), 3, test::some_rotation(), {1, 2, 3}), 0.055}};
  for (const auto& [mesh, largest] : cases) {
    const MatchShape shape(shared(test::quickly_prepared(mesh)));
    const MatchResult result = symmetry(shape);
    EXPECT_TRUE(result.reversed);
    EXPECT_LT(error(result, shape.surface()), largest);
    EXPECT_LT(quality(result, "involution_mean"), 0.015);
    EXPECT_GE(quality(result, "involution_max"), quality(result, "involution_mean"));
  }
}

TEST_F(Symmetry, ExchangesSidesRatherThanChestAndBack) {
  const TriMesh mesh = chest_and_back(3);
  const MatchShape shape(shared(test::quickly_prepared(mesh)));
  const MatchResult result = symmetry(shape);
  const auto mean = [&](const Eigen::RowVector3d& signs) {
    double sum = 0;
    for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
      Eigen::RowVector3d image = Eigen::RowVector3d::Zero();
      for (int k = 0; k < 3; ++k) image += static_cast<double>(result.map.bary(v, k)) * mesh.vertices.row(result.map.corners(v, k));
      sum += (image - mesh.vertices.row(v).cwiseProduct(signs)).norm();
    }
    return sum / static_cast<double>(mesh.vertex_count()) / std::sqrt(test::total_area(mesh));
  };
  EXPECT_LT(mean({1, -1, 1}), 0.06);
  EXPECT_GT(mean({1, 1, -1}), 0.1);
  // Measured: 2.1 times.
  EXPECT_GT(quality(result, "score_runner_up"), 1.5 * quality(result, "score"));
}

TEST_F(Symmetry, IsTheSameAtAnyNumberOfThreads) {
  const MatchShape shape(shared(test::quickly_prepared(posed(rest_))));
  const MatchResult one = symmetry(shape, 1), two = symmetry(shape, 2);
  EXPECT_EQ(one.map.vertex, two.map.vertex);
  EXPECT_EQ(one.map.bary, two.map.bary);
  EXPECT_EQ(one.quality, two.quality);
}

TEST_F(Symmetry, OnlyAShapeWithItselfReversedIsAnInvolution) {
  const auto has_residual = [](const MatchResult& result) {
    return std::any_of(result.quality.begin(), result.quality.end(), [](const auto& figure) { return figure.first == "involution_mean"; });
  };
  const PreprocessedShape shape = test::quickly_prepared(rest_), other = test::quickly_prepared(posed(rest_));
  MatchParameters parameters;
  parameters.flow_times = {0.5, 0.25};
  EXPECT_FALSE(has_residual(match(shape, shape, parameters)));
  parameters.orientation = Orientation::reverse;
  EXPECT_TRUE(has_residual(match(shape, shape, parameters)));
  EXPECT_FALSE(has_residual(match(shape, other, parameters)));
}

}  // namespace
}  // namespace spherematch
