#include "engine/evaluate/evaluation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/evaluate/biharmonic.h"
#include "engine/evaluate/bijectivity.h"
#include "engine/evaluate/map_error.h"
#include "engine/mesh/laplacian.h"
#include "engine/spectrum/eigenbasis.h"
#include "tests/engine/evaluate/surfaces.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

constexpr int degrees = 10;  ///< of the spherical harmonics in the eigenbasis

/// The sphere with its eigenpairs up to a whole degree, as preprocess() leaves them.
PreprocessedShape sphere_shape(const TriMesh& sphere) {
  PreprocessedShape shape;
  shape.surface = test::surface_of(sphere);
  TriMesh unit = sphere;
  unit.vertices /= unit_length(shape.surface);
  PreprocessParameters parameters;
  parameters.eigenpairs = (degrees + 1) * (degrees + 1);
  const FloatEigenbasis basis = surface_eigenbasis(unit, parameters, 1, {});
  shape.eigenvalues = basis.values;
  shape.eigenvectors = basis.vectors;
  return shape;
}

/// Of two points of the sphere of unit area, by the addition theorem, from their angle's cosine.
double squared_biharmonic(double cosine) {
  double sum = 0;
  for (int l = 1; l <= degrees; ++l) {
    const double eigenvalue = 4 * std::numbers::pi * l * (l + 1);
    sum += (2 * l + 1) * 2 * (1 - std::legendre(static_cast<unsigned>(l), cosine)) / (eigenvalue * eigenvalue);
  }
  return sum;
}

/// Half a turn about the z axis, as a permutation of the vertices, which is its own inverse.
std::vector<std::int32_t> half_turn(const TriMesh& sphere) {
  std::vector<std::int32_t> targets;
  for (const auto& vertex : sphere.vertices.rowwise()) {
    const Eigen::RowVector3d image(-vertex[0], -vertex[1], vertex[2]);
    Eigen::Index nearest = 0;
    EXPECT_LT((sphere.vertices.rowwise() - image).rowwise().squaredNorm().minCoeff(&nearest), 1e-20);
    targets.push_back(static_cast<std::int32_t>(nearest));
  }
  return targets;
}

class OnTheSphere : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    mesh = new TriMesh(test::icosphere(4));
    shape = new PreprocessedShape(sphere_shape(*mesh));
  }
  static void TearDownTestSuite() {
    delete shape;
    delete mesh;
  }
  static double cosine_of_half_turn(Eigen::Index vertex) {
    const Eigen::RowVector3d p = mesh->vertices.row(vertex);
    return p[2] * p[2] - p[0] * p[0] - p[1] * p[1];
  }
  static const TriMesh* mesh;
  static const PreprocessedShape* shape;
};
const TriMesh* OnTheSphere::mesh = nullptr;
const PreprocessedShape* OnTheSphere::shape = nullptr;

TEST_F(OnTheSphere, BiharmonicDistancesFollowTheAdditionTheorem) {
  std::vector<PlacedPoint> from, to;
  for (const std::int32_t v : {1, 17, 200, 1000, 2561}) {
    from.push_back(*place_of(shape->surface, 0));
    to.push_back(*place_of(shape->surface, v));
  }
  const std::vector<double> distances = biharmonic_distances(*shape, from, to, {});
  for (std::size_t i = 0; i < to.size(); ++i) {
    const double expected = std::sqrt(squared_biharmonic(from[i].position.dot(to[i].position)));
    EXPECT_NEAR(distances[i] / expected, 1, 0.01) << i;
  }
  EXPECT_EQ(biharmonic_distances(*shape, to, to, {}), std::vector<double>(to.size(), 0.0));
}

TEST_F(OnTheSphere, BiharmonicDistancesBetweenVerticesAreInterpolated) {
  const auto face = mesh->faces.row(40);
  const PlacedPoint corner = *place_of(shape->surface, face[0]);
  const PlacedPoint middle{{face[0], face[1], face[2]}, {0.5, 0.5, 0}, (mesh->vertices.row(face[0]) + mesh->vertices.row(face[1])) / 2};
  const std::vector<PlacedPoint> from{corner, corner}, to{middle, *place_of(shape->surface, face[1])};
  const std::vector<double> distances = biharmonic_distances(*shape, from, to, {});
  EXPECT_NEAR(distances[0], distances[1] / 2, 1e-9);
}

TEST_F(OnTheSphere, ADecimatedCopyWithTheSameVerticesChangesNothing) {
  PreprocessedShape copy = *shape;
  DecimatedMesh same{.mesh = shape->surface.mesh, .places = {}, .seconds = 0};
  same.places.resize(static_cast<std::size_t>(mesh->vertex_count()));
  for (Eigen::Index f = 0; f < same.mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      SurfacePoint& place = same.places[static_cast<std::size_t>(same.mesh.faces(f, k))];
      place = {.face = static_cast<std::int32_t>(f), .weights = {}};
      place.weights.at(static_cast<std::size_t>(k)) = 1;
    }
  }
  copy.surface.decimated = same;
  const std::vector<PlacedPoint> from{*place_of(copy.surface, 3)}, to{*place_of(copy.surface, 1500)};
  EXPECT_EQ(biharmonic_distances(copy, from, to, {}), biharmonic_distances(*shape, from, to, {}));
}

TEST_F(OnTheSphere, TheIdentityIsPerfect) {
  const Correspondence identity = test::identity_map(*mesh);
  const std::int32_t n = shape->surface.uploaded_vertices();
  const Evaluation result = evaluate_map(*shape, *shape, identity, &identity, identity_truth(n, n), {}, 2);
  ASSERT_TRUE(result.geodesic && result.biharmonic && result.symmetric_integral && result.bijectivity && result.bijectivity_biharmonic);
  for (const auto& error : {result.geodesic, result.biharmonic, result.bijectivity, result.bijectivity_biharmonic}) {
    EXPECT_EQ(error->max, 0);
    EXPECT_EQ(error->scored, n);
    EXPECT_EQ(error->curve, std::vector<double>(curve_steps + 1, 1.0));
    EXPECT_NEAR(error->auc, 1, 1e-12);
    EXPECT_EQ(error->area_mean, 0);
  }
  EXPECT_EQ(*result.symmetric_integral, 0);
  EXPECT_FALSE(result.flipped);
  EXPECT_NEAR(result.coverage.area, 1, 1e-12);
  EXPECT_EQ(result.seconds.back().first, "total");
}

TEST_F(OnTheSphere, HalfATurnHasTheIntegralOfItsKnownDistances) {
  const Correspondence turn = test::vertex_map(half_turn(*mesh), *mesh);
  const std::int32_t n = shape->surface.uploaded_vertices();
  const Evaluation result = evaluate_map(*shape, *shape, turn, &turn, identity_truth(n, n), {}, 2);
  const Eigen::VectorXd areas = vertex_areas(mesh->vertices, mesh->faces);
  double integral = 0, arcs = 0;
  for (Eigen::Index v = 0; v < n; ++v) {
    integral += areas[v] / areas.sum() * squared_biharmonic(cosine_of_half_turn(v));
    arcs += std::acos(std::clamp(cosine_of_half_turn(v), -1.0, 1.0)) / n;
  }
  EXPECT_NEAR(*result.symmetric_integral / std::sqrt(2 * integral), 1, 0.01);
  EXPECT_NEAR(*result.geodesic->area_mean / result.geodesic->mean, 1, 0.01) << "the vertices stand for nearly equal areas";
  EXPECT_NE(*result.geodesic->area_mean, result.geodesic->mean);
  const double mean = arcs / std::sqrt(4 * std::numbers::pi);
  EXPECT_GT(result.geodesic->mean, mean * 0.998);
  EXPECT_LT(result.geodesic->mean, mean * 1.04);
  EXPECT_EQ(result.bijectivity->max, 0) << "it is its own inverse";
}

TEST_F(OnTheSphere, ThereAndBackIsMeasuredOnTheSource) {
  const Correspondence turn = test::vertex_map(half_turn(*mesh), *mesh), identity = test::identity_map(*mesh);
  const std::int32_t n = shape->surface.uploaded_vertices();
  const Evaluation error = evaluate_map(*shape, *shape, turn, nullptr, identity_truth(n, n), {}, 1);
  EXPECT_FALSE(error.bijectivity);
  EXPECT_FALSE(error.symmetric_integral) << "needs both directions";
  for (const auto& [there, back] : {std::pair(&turn, &identity), std::pair(&identity, &turn)}) {
    const Evaluation trip = evaluate_map(*shape, *shape, *there, back, {}, {}, 1);
    EXPECT_FALSE(trip.geodesic) << "without a truth";
    EXPECT_NEAR(trip.bijectivity->mean, error.geodesic->mean, 1e-12);
    EXPECT_NEAR(trip.bijectivity_biharmonic->mean, error.biharmonic->mean, 1e-12);
  }
}

TEST_F(OnTheSphere, FlippedIsWhatIsNearerToTheMirroredTruth) {
  const Correspondence turn = test::vertex_map(half_turn(*mesh), *mesh);
  const std::int32_t n = shape->surface.uploaded_vertices();
  GroundTruth truth{.direct = identity_truth(n, n).direct, .mirrored = paired(test::numbers_to(n), turn.vertex), .dense = false};
  PreprocessedShape surface_alone;
  surface_alone.surface = shape->surface;
  const Evaluation flipped = evaluate_map(surface_alone, surface_alone, turn, nullptr, truth, {}, 1);
  EXPECT_TRUE(*flipped.flipped);
  EXPECT_EQ(flipped.mirrored->max, 0);
  EXPECT_FALSE(flipped.biharmonic) << "without an eigenbasis";
  EXPECT_FALSE(flipped.geodesic->area_mean) << "not said to be dense";
  EXPECT_FALSE(*evaluate_map(surface_alone, surface_alone, test::identity_map(*mesh), nullptr, truth, {}, 1).flipped);
}

TEST_F(OnTheSphere, ThreadsChangeNoBit) {
  const Correspondence turn = test::vertex_map(half_turn(*mesh), *mesh);
  const std::int32_t n = shape->surface.uploaded_vertices();
  const Evaluation one = evaluate_map(*shape, *shape, turn, &turn, identity_truth(n, n), {}, 1);
  const Evaluation three = evaluate_map(*shape, *shape, turn, &turn, identity_truth(n, n), {}, 3);
  EXPECT_EQ(one.geodesic->mean, three.geodesic->mean);
  EXPECT_EQ(one.continuity.edge_distortion, three.continuity.edge_distortion);
  EXPECT_EQ(one.bijectivity->curve, three.bijectivity->curve);
}

TEST_F(OnTheSphere, WhatDoesNotFitIsRefused) {
  const Correspondence identity = test::identity_map(*mesh);
  const TriMesh small = test::icosphere(1);
  PreprocessedShape other;
  other.surface = test::surface_of(small);
  const auto refused = [](const auto& call) { test::expect_refusal(ErrorCode::invalid_parameter, call); };
  refused([&] { (void)evaluate_map(other, *shape, identity, nullptr, {}, {}, 1); });
  refused([&] { (void)evaluate_map(*shape, other, identity, nullptr, {}, {}, 1); });
  const Correspondence small_identity = test::identity_map(small);
  refused([&] { (void)evaluate_map(*shape, *shape, identity, &small_identity, {}, {}, 1); });
  refused([&] { (void)evaluate_map(*shape, *shape, identity, nullptr, index_truth({0, 5000}), {}, 1); });
  refused([&] { (void)evaluate_map(*shape, *shape, identity, nullptr, index_truth({-2}), {}, 1); });
  refused([&] { (void)identity_truth(3, 4); });
  refused([&] { (void)paired({1, 2}, {1}); });
  std::stop_source stop;
  stop.request_stop();
  test::expect_refusal(ErrorCode::cancelled, [&] {
    const std::int32_t n = shape->surface.uploaded_vertices();
    (void)evaluate_map(*shape, *shape, identity, nullptr, identity_truth(n, n), {.report = {}, .stop = stop.get_token()}, 1);
  });
}

TEST(Truth, IndexListsLeaveOutWhatIsNotKnown) {
  const GroundTruth truth = index_truth({4, -1, 2});
  ASSERT_EQ(truth.direct.size(), 2U);
  EXPECT_EQ(truth.direct[1].source, 2);
  EXPECT_EQ(truth.direct[1].target, 2);
  EXPECT_TRUE(truth.dense);
}

TEST(Summary, CurvesCountWhatIsWithinEachThreshold) {
  const MapError error = summarize({0, 0.1, 0.2, 1}, 3);
  EXPECT_EQ(error.scored, 4);
  EXPECT_EQ(error.unscored, 3);
  ASSERT_EQ(error.curve.size(), static_cast<std::size_t>(curve_steps + 1));
  EXPECT_EQ(error.curve[0], 0.25);
  EXPECT_EQ(error.curve[39], 0.25);
  EXPECT_EQ(error.curve[41], 0.5);
  EXPECT_EQ(error.curve[100], 0.75);
  EXPECT_NEAR(error.auc, (1 + 0.6 + 0.2 + 0) / 4, 1e-12);
  EXPECT_TRUE(summarize({}, 2).curve.empty());
}

TEST(MeanByArea, CountsAreasAndSharesThem) {
  const TriMesh sphere = test::icosphere(2);
  const Surface surface = test::surface_of(sphere);
  const Eigen::VectorXd areas = vertex_areas(sphere.vertices, sphere.faces);
  const std::vector<std::int32_t> two{0, 40};  // of valence five and six
  EXPECT_NEAR(mean_by_area(surface, two, std::vector<double>{2, 2}), 2, 1e-12);
  EXPECT_NEAR(mean_by_area(surface, two, std::vector<double>{1, 0}), areas[0] / (areas[0] + areas[40]), 1e-12);
  const std::vector<std::int32_t> shared{0, 0, 40};
  EXPECT_NEAR(mean_by_area(surface, shared, std::vector<double>{1, 1, 0}), areas[0] / (areas[0] + areas[40]), 1e-12);
  EXPECT_EQ(mean_by_area(surface, {}, {}), 0);
}

}  // namespace
}  // namespace spherematch
