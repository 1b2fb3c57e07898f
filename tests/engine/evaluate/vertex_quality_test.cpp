#include "engine/evaluate/vertex_quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/data/error.h"
#include "engine/evaluate/surface_distance.h"
#include "engine/spectrum/signatures.h"
#include "tests/engine/evaluate/surfaces.h"
#include "tests/engine/sphere/spheres.h"

namespace spherematch {
namespace {

using Function = std::function<double(const Eigen::Vector3d&)>;

/// The icosphere, stretched along x, with one function as all of its signals.
MatchShape shape(const TriMesh& sphere, double stretch, const Function& signal = test::smooth_function) {
  PreprocessedShape shape;
  TriMesh mesh = sphere;
  mesh.vertices.col(0) *= stretch;
  shape.surface = test::surface_of(mesh);
  shape.sphere = sphere.vertices;
  const Eigen::MatrixXf grid = test::sampled(64, signal).matrix().cast<float>();
  for (const std::string& name : selection_signal_names()) shape.signals.push_back({name, grid});
  return MatchShape(std::make_shared<const PreprocessedShape>(std::move(shape)));
}

TEST(VertexQuality, AnIsometryIsTrustedMost) {
  const TriMesh sphere = test::icosphere(4);
  const MatchShape body = shape(sphere, 1);
  const VertexQuality quality = vertex_quality(body, body, test::identity_map(sphere));
  ASSERT_EQ(quality.distortion.size(), static_cast<std::size_t>(sphere.vertex_count()));
  EXPECT_LT(*std::max_element(quality.distortion.begin(), quality.distortion.end()), 1e-6F);
  EXPECT_GT(*std::min_element(quality.confidence.begin(), quality.confidence.end()), 0.99F);
}

TEST(VertexQuality, DistortionIsThatOfTheStretchBetweenUnitAreas) {
  // Where the normal is x the stretch along x does nothing but that areas are divided by the whole area.
  const TriMesh sphere = test::icosphere(4);
  const MatchShape ball = shape(sphere, 1), spindle = shape(sphere, 3);
  const double shrink = std::log(unit_length(ball.surface()) / unit_length(spindle.surface()));
  const VertexQuality quality = vertex_quality(ball, spindle, test::identity_map(sphere));
  Eigen::Index pole = 0, equator = 0;
  sphere.vertices.col(0).maxCoeff(&pole);
  sphere.vertices.col(1).maxCoeff(&equator);
  EXPECT_NEAR(quality.distortion[static_cast<std::size_t>(pole)], std::abs(shrink), 0.02);
  // Along the equator's meridian it stretches by 3, across it not at all.
  const double expected = std::sqrt((std::pow(std::log(3) + shrink, 2) + std::pow(shrink, 2)) / 2);
  EXPECT_NEAR(quality.distortion[static_cast<std::size_t>(equator)], expected, 0.02);
  EXPECT_LT(quality.confidence[static_cast<std::size_t>(equator)], quality.confidence[static_cast<std::size_t>(pole)]);
}

TEST(VertexQuality, ConfidenceFallsWhereSignalsDiffer) {
  const TriMesh sphere = test::icosphere(3);
  const Function other = [](const Eigen::Vector3d& p) { return test::smooth_function(p) + (p[2] > 0.5 ? 1.0 : 0.0); };
  const VertexQuality quality = vertex_quality(shape(sphere, 1), shape(sphere, 1, other), test::identity_map(sphere));
  Eigen::Index top = 0, bottom = 0;
  sphere.vertices.col(2).maxCoeff(&top);
  sphere.vertices.col(2).minCoeff(&bottom);
  EXPECT_LT(quality.confidence[static_cast<std::size_t>(top)], quality.confidence[static_cast<std::size_t>(bottom)]);
}

TEST(VertexQuality, ARandomMapIsNotTrusted) {
  const TriMesh sphere = test::icosphere(3);
  const MatchShape body = shape(sphere, 1);
  const auto count = static_cast<std::int32_t>(sphere.vertex_count());
  std::vector<std::int32_t> scattered;
  for (std::int32_t i = 0; i < count; ++i) scattered.push_back(static_cast<std::int32_t>((i * std::int64_t{7919}) % count));
  const VertexQuality quality = vertex_quality(body, body, test::vertex_map(scattered, sphere));
  EXPECT_LT(*std::max_element(quality.confidence.begin(), quality.confidence.end()), 0.1F);
  EXPECT_LE(*std::max_element(quality.distortion.begin(), quality.distortion.end()), 3.0F);
}

TEST(VertexQuality, ADroppedVertexHasNone) {
  const TriMesh sphere = test::icosphere(2);
  const MatchShape body = shape(sphere, 1);
  std::vector<std::int32_t> targets = test::numbers_to(sphere.vertex_count());
  targets[5] = -1;
  const VertexQuality quality = vertex_quality(body, body, test::vertex_map(targets, sphere));
  EXPECT_EQ(quality.confidence[5], 0);
  EXPECT_EQ(quality.distortion[5], 0);
  EXPECT_GT(quality.confidence[6], 0.99F);
}

TEST(VertexQuality, RefusesTheMapOfAnotherShape) {
  const MatchShape body = shape(test::icosphere(2), 1);
  EXPECT_THROW((void)vertex_quality(body, body, test::identity_map(test::icosphere(1))), EngineError);
}

}  // namespace
}  // namespace spherematch
