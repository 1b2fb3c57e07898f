#include "engine/sphere/authalic_evolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/mesh/laplacian.h"
#include "engine/sphere/conformal_flow.h"
#include "engine/sphere/orientation.h"
#include "engine/sphere/rasterizer.h"
#include "tests/engine/sphere/spheres.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::icosphere;

constexpr double pi = std::numbers::pi;

/// The paper's constants, whatever the defaults are.
PreprocessParameters constants() {
  PreprocessParameters parameters;
  parameters.authalic_resolution = 128;
  parameters.authalic_steps = 100;
  parameters.authalic_step_size = 0.005;
  parameters.authalic_smoothing = 0.0025;
  parameters.exact_rasterization = true;
  return parameters;
}

void evolve(Points& sphere, const TriMesh& surface, const PreprocessParameters& parameters) {
  evolve_authalically(sphere, surface, parameters, {}, [](double) {});
}

/// Coefficient (l, 0) of the log density on a grid.
double log_density(const Points& sphere, const TriMesh& surface, int l) {
  const HarmonicTransform transform(64, 31);
  const Eigen::VectorXd areas = face_areas(surface.vertices, surface.faces);
  const Grid density = rasterize_mass(sphere, surface.faces, areas, 64).colwise() / cell_areas(64).array();
  return transform.analyze(density.log())[harmonic_index(31, l, 0)].real();
}

/// The amplitude of mode (l, 0) before and after the evolution of a sphere under the areas of a surface that bulges out and in by
/// that mode, so that to first order its area density is 1 + epsilon Y_l0.
std::pair<double, double> amplitudes(const TriMesh& mesh, int l, double epsilon, const PreprocessParameters& parameters) {
  TriMesh surface = mesh;
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v)
    surface.vertices.row(v) *= 1 + epsilon / 2 * test::exact_harmonic(l, 0, mesh.vertices.row(v).transpose()).real();
  Points sphere = mesh.vertices;
  const double before = log_density(sphere, surface, l);
  evolve(sphere, surface, parameters);
  EXPECT_TRUE(flipped_faces(sphere, mesh.faces).empty());
  return {before, log_density(sphere, surface, l)};
}

TEST(AuthalicEvolution, DecaysASingleModeAsTheFormulaSays) {
  const TriMesh mesh = icosphere(4);
  PreprocessParameters parameters = constants();
  for (const auto& [l, steps] : {std::pair(2, 100), std::pair(3, 25)}) {
    parameters.authalic_steps = steps;
    // The difference of opposite signs is free of the grid's own bias, which has the order of the small amplitudes, and of
    // everything quadratic.
    const double epsilon = 0.02;
    const auto [before_plus, after_plus] = amplitudes(mesh, l, epsilon, parameters);
    const auto [before_minus, after_minus] = amplitudes(mesh, l, -epsilon, parameters);
    const double before = (before_plus - before_minus) / 2, after = (after_plus - after_minus) / 2;
    // Linearised, each step multiplies mode l by 1 - dt l (l + 1) exp(-tau l (l + 1)): 0.0498 for l = 2 after a hundred.
    const double eigenvalue = l * (l + 1), expected = std::pow(1 - 0.005 * eigenvalue * std::exp(-0.0025 * eigenvalue), steps);
    // Measured: 0.9958 and 0.9914 of epsilon; ratios of 1.002 and 1.006 times the expected.
    EXPECT_NEAR(before, epsilon, 0.02 * epsilon);
    EXPECT_NEAR(after / before, expected, 0.012 * expected);
  }
}

TEST(AuthalicEvolution, BySamplesDecaysAModeAlmostAsFast) {
  const TriMesh mesh = icosphere(4);
  PreprocessParameters parameters = constants();
  parameters.exact_rasterization = false;
  parameters.authalic_steps = 25;
  const double epsilon = 0.02;
  const auto [before_plus, after_plus] = amplitudes(mesh, 3, epsilon, parameters);
  const auto [before_minus, after_minus] = amplitudes(mesh, 3, -epsilon, parameters);
  const double expected = std::pow(1 - 0.005 * 12 * std::exp(-0.0025 * 12), 25);  // 0.223
  // Samples of large faces are noise of a few thousandths of the density. Measured: 0.240.
  EXPECT_NEAR((after_plus - after_minus) / (before_plus - before_minus), expected, 0.03);
}

class BySamples : public ::testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Grids, BySamples, ::testing::Values(256, PreprocessParameters{}.authalic_resolution));

TEST_P(BySamples, AreasBecomeAsEqualAsByTheExactRasteriser) {
  for (const TriMesh& mesh : {test::creature(4), test::ellipsoid(5, {1, 1.5, 2.5})}) {
    const Points start = conformal_parametrization(mesh, {}, {});
    PreprocessParameters parameters;
    parameters.authalic_resolution = GetParam();
    Points sampled = start, exact = start;
    evolve(sampled, mesh, parameters);
    parameters.exact_rasterization = true;
    evolve(exact, mesh, parameters);
    const SphereQuality a = measure_sphere(sampled, mesh), b = measure_sphere(exact, mesh);
    EXPECT_EQ(a.flipped, 0);
    // Measured at 256: 0.0452 and 0.0453, 5.1e-4 apart; 0.0227 and 0.0230, 5.7e-4 apart. At 160: 0.0471 and 0.0459; 0.0236 and 0.0229.
    EXPECT_LT(a.area_distortion, (GetParam() == 256 ? 1.02 : 1.05) * b.area_distortion);
    EXPECT_LT(std::sqrt((sampled - exact).rowwise().squaredNorm().mean()), 0.0012);
  }
}

TEST(AuthalicEvolution, LeavesAUniformDensityAlone) {
  // Not exactly: faces are rasterised as flat pieces, and the grid sees its own poles.
  double previous = 1;
  for (const int level : {3, 4}) {
    const TriMesh mesh = icosphere(level);
    Points sphere = mesh.vertices;
    evolve(sphere, mesh, constants());
    const double moved = (sphere - mesh.vertices).rowwise().norm().maxCoeff();
    EXPECT_LT(moved, previous);
    previous = moved;
  }
  // Measured: 2.2e-4, 1.0e-4.
  EXPECT_LT(previous, 2e-4);
}

TEST(AuthalicEvolution, MakesAnEllipsoidsAreasEqual) {
  const TriMesh mesh = test::ellipsoid(4, {1, 1.5, 2.5});
  Points sphere = conformal_parametrization(mesh, {}, {});
  double previous = measure_sphere(sphere, mesh).area_distortion;
  const double first = previous;
  PreprocessParameters parameters = constants();
  parameters.authalic_steps = 25;
  for (int part = 0; part < 4; ++part) {
    evolve(sphere, mesh, parameters);
    const SphereQuality quality = measure_sphere(sphere, mesh);
    EXPECT_LT(quality.area_distortion, previous);
    EXPECT_EQ(quality.flipped, 0);
    EXPECT_LT(quality.solid_angle_defect, 1e-12);
    EXPECT_LT((sphere.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
    previous = quality.area_distortion;
  }
  // Measured: from 0.52 to 0.024.
  EXPECT_LT(previous, first / 10);
}

TEST(AuthalicEvolution, FlipsNothingOnLongLimbs) {
  const TriMesh mesh = test::creature(4);
  Points sphere = conformal_parametrization(mesh, {}, {});
  const double before = measure_sphere(sphere, mesh).area_distortion;
  evolve(sphere, mesh, constants());
  const SphereQuality quality = measure_sphere(sphere, mesh);
  EXPECT_EQ(quality.flipped, 0);
  // Measured: from 1.58 to 0.047.
  EXPECT_LT(quality.area_distortion, before / 15);
}

TEST(AuthalicEvolution, ReportsRisingFractionsAndStopsWhenAsked) {
  const TriMesh mesh = icosphere(2);
  PreprocessParameters parameters = constants();
  parameters.authalic_resolution = 32;
  Points sphere = mesh.vertices;
  std::vector<double> fractions;
  evolve_authalically(sphere, mesh, parameters, {}, [&](double fraction) { fractions.push_back(fraction); });
  ASSERT_GT(fractions.size(), 5U);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0);
  EXPECT_LE(fractions.back(), 1);

  std::stop_source source;
  int calls = 0;
  const auto stop_at_fifth = [&](double) {
    if (++calls == 5) source.request_stop();
  };
  const Progress progress{{}, source.get_token()};
  test::expect_refusal(ErrorCode::cancelled, [&] { evolve_authalically(sphere, mesh, parameters, progress, stop_at_fifth); });
  EXPECT_LE(calls, 6);
}

}  // namespace
}  // namespace spherematch
