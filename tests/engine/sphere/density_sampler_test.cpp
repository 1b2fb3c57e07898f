#include "engine/sphere/density_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/sphere/grid_place.h"
#include "engine/sphere/rasterizer.h"
#include "tests/engine/sphere/spheres.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

using test::icosphere;
using test::Random;

constexpr double pi = std::numbers::pi;

TEST(GridPlace, IsThatOfTheLibrarysArcTangents) {
  Random random(1);
  const auto expect_place = [](const Eigen::Vector3d& p) {
    const GridPlace place = grid_place(p[0], p[1], p[2]);
    const double longitude = std::atan2(p[1], p[0]) + (p[1] < 0 ? 2 * pi : 0);
    EXPECT_NEAR(place.colatitude, std::atan2(std::hypot(p[0], p[1]), p[2]) / pi, 2e-11);
    EXPECT_NEAR(place.longitude, longitude / (2 * pi), 2e-11);
    EXPECT_TRUE(place.colatitude >= 0 && place.colatitude <= 1 && place.longitude >= 0 && place.longitude <= 1);
  };
  for (int i = 0; i < 10000; ++i) expect_place(random.uniform(0.1, 3) * random.unit_vector());
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double y : {-1.0, 0.0, 1.0})
      for (const double z : {-1.0, 0.0, 1.0}) expect_place({x, y, z});
}

/// What the logarithms add up to as mass.
double total(const Grid& log_density) {
  return (log_density.exp().rowwise().sum() * cell_areas(static_cast<int>(log_density.rows())).array()).sum();
}

TEST(DensitySampler, OfAUniformDensityIsNearlyConstant) {
  for (const int resolution : {16, 30, 64, 256}) {
    const TriMesh mesh = icosphere(5);
    const Points sphere = test::rotated(mesh.vertices, Random(2).rotation()).rowwise().normalized();
    const Eigen::VectorXd mass = test::solid_angles(sphere, mesh.faces);
    const Grid grid = DensitySampler(resolution).log_density(sphere, mesh.faces, mass, 1e-12);
    ASSERT_EQ(grid.rows(), resolution);
    ASSERT_EQ(grid.cols(), resolution);
    // Measured: 1.4e-4, 4.1e-4 at first, and 0.056, 0.33 at last, where the cells are smaller than the faces.
    EXPECT_LT(std::sqrt(grid.square().mean()), resolution < 256 ? 4e-3 : 0.1);
    EXPECT_LT(grid.abs().maxCoeff(), resolution < 256 ? 0.015 : 0.6);
    EXPECT_NEAR(total(grid), 4 * pi, 0.01 * 4 * pi);
  }
}

TEST(DensitySampler, AgreesWithTheRasteriserOnSmoothParts) {
  // A density of smooth_function's exponential, on needles as on even triangles.
  for (const bool stretched : {false, true}) {
    TriMesh mesh = icosphere(stretched ? 4 : 5);
    if (stretched) {
      mesh.vertices.col(2) *= 8;
      mesh.vertices.rowwise().normalize();
    }
    const Points sphere = test::rotated(mesh.vertices, Random(3).rotation()).rowwise().normalized();
    Eigen::VectorXd mass = test::solid_angles(sphere, mesh.faces);
    for (Eigen::Index f = 0; f < mass.size(); ++f) mass[f] *= std::exp(test::smooth_function(sphere.row(mesh.faces(f, 0)).transpose()));
    constexpr int resolution = 128, degree = 24;
    const HarmonicTransform transform(resolution, degree);
    const Grid exact = (rasterize_mass(sphere, mesh.faces, mass, resolution).colwise() / cell_areas(resolution).array()).log();
    const Harmonics a = transform.analyze(DensitySampler(resolution).log_density(sphere, mesh.faces, mass, 1e-12)),
                    b = transform.analyze(exact), d = a - b;
    // Measured: 0.0053 and, where faces are eight times as long as wide, 0.045.
    EXPECT_LT(std::sqrt(harmonic_dot(degree, d, d)), stretched ? 0.09 : 0.011);
    EXPECT_GT(std::sqrt(harmonic_dot(degree, b, b)), 1.5);
  }
}

TEST(DensitySampler, KeepsEmptyCellsFinite) {
  // Only the southern half of an octahedron.
  TriMesh mesh = test::octahedron();
  mesh.faces = mesh.faces.bottomRows(4).eval();
  const Grid grid = DensitySampler(32).log_density(mesh.vertices, mesh.faces, Eigen::VectorXd::Ones(4), 1e-9);
  ASSERT_TRUE(grid.allFinite());
  EXPECT_NEAR(grid.topRows(12).maxCoeff(), std::log(1e-9), 1e-12);
  EXPECT_GT(grid.bottomRows(12).minCoeff(), std::log(0.1));
  // Vertices that coincide deposit their mass at their place.
  Points point = Points::Zero(6, 3);
  point.col(0).setOnes();
  EXPECT_TRUE(DensitySampler(32).log_density(point, mesh.faces, Eigen::VectorXd::Ones(4), 1e-9).allFinite());
}

}  // namespace
}  // namespace spherematch
