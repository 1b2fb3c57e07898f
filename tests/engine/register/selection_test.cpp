#include "engine/register/selection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/mesh/intrinsic_delaunay.h"
#include "engine/mesh/laplacian.h"
#include "engine/spectrum/eigenbasis.h"
#include "engine/spectrum/signatures.h"
#include "engine/sphere/rasterizer.h"
#include "tests/engine/sphere/spheres.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

constexpr int kResolution = 64;

Points turned_nodes(const Eigen::Matrix3d& turn) { return cell_centers(kResolution) * turn.transpose(); }

TEST(SelectionSignals, TellTheEndsOfABodyApart) {
  TriMesh mesh = test::creature(3);
  mesh.vertices /= std::sqrt(face_areas(mesh.vertices, mesh.faces).sum());
  IntrinsicMesh intrinsic = intrinsic_mesh(mesh);
  make_delaunay(intrinsic);
  const Eigenbasis basis = compute_eigenbasis(cotangent_laplacian(intrinsic, mesh.vertex_count()), 60, {});
  const Eigen::MatrixXd signals = selection_signals(basis.values, basis.vectors.cast<float>());
  ASSERT_EQ(signals.rows(), mesh.vertex_count());
  ASSERT_EQ(signals.cols(), static_cast<Eigen::Index>(selection_signal_names().size()));
  EXPECT_TRUE(signals.allFinite());

  const GridSamples samples(rasterize_signals(mesh.vertices.rowwise().normalized(), mesh.faces, signals, kResolution));
  std::vector<Eigen::Index> all;
  for (Eigen::Index c = 0; c < signals.cols(); ++c) all.push_back(c);
  const Points straight = turned_nodes(Eigen::Matrix3d::Identity());
  const auto cost = [&](const Eigen::Matrix3d& turn) {
    const Points turned = turned_nodes(turn);
    return registration_cost({samples, all, turned}, {samples, all, straight}, selection_signal_weights(), kResolution);
  };
  EXPECT_EQ(cost(Eigen::Matrix3d::Identity()), 0);
  const double slightly = cost(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX()).toRotationMatrix());
  EXPECT_GT(slightly, 0);
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)})
    EXPECT_GT(cost(Eigen::AngleAxisd(std::numbers::pi, axis).toRotationMatrix()), 2 * slightly);
}

/// 1, x, z and -z, the last in a pack of its own.
const GridSamples& known_functions() {
  static const GridSamples samples({test::sampled(kResolution, [](const Eigen::Vector3d&) { return 1.0; }),
                                    test::sampled(kResolution, [](const Eigen::Vector3d& p) { return p[0]; }),
                                    test::sampled(kResolution, [](const Eigen::Vector3d& p) { return p[2]; }),
                                    test::sampled(kResolution, [](const Eigen::Vector3d&) { return 3.0; }),
                                    test::sampled(kResolution, [](const Eigen::Vector3d& p) { return -p[2]; })});
  return samples;
}

double cost_between(const std::vector<Eigen::Index>& f, const std::vector<Eigen::Index>& g, const std::vector<double>& weights) {
  const Points nodes = turned_nodes(Eigen::Matrix3d::Identity());
  return registration_cost({known_functions(), f, nodes}, {known_functions(), g, nodes}, weights, kResolution);
}

TEST(RegistrationCost, IsTheRootOfTheMeanSquareDifference) {
  EXPECT_EQ(cost_between({1, 2}, {1, 2}, {1, 1}), 0);
  EXPECT_NEAR(cost_between({3}, {0}, {1}), 2, 1e-12);
  // The mean of 4 z^2 over the sphere is 4/3, that of (x - z)^2 is 2/3. Measured: 4e-4.
  EXPECT_NEAR(cost_between({2}, {4}, {1}), std::sqrt(4.0 / 3), 1e-3);
  EXPECT_NEAR(cost_between({1}, {2}, {1}), std::sqrt(2.0 / 3), 1e-3);
  EXPECT_NEAR(cost_between({3, 2}, {0, 4}, {1, 3}), std::sqrt((4 + 3 * 4.0 / 3) / 4), 1e-3);
}

double paper_cost_between(const std::vector<Eigen::Index>& f, const std::vector<Eigen::Index>& g) {
  const Points nodes = turned_nodes(Eigen::Matrix3d::Identity());
  return paper_cost({known_functions(), f, nodes}, {known_functions(), g, nodes}, kResolution);
}

TEST(PaperCost, OfKnownFunctionsIsTheirMeanDifference) {
  EXPECT_EQ(paper_cost_between({2}, {2}), 0);
  EXPECT_NEAR(paper_cost_between({3}, {0}), 2, 1e-12);
  // Degree one is damped by exp(-2 tau), tau = ln(100) / (32 * 33).
  const double damping = std::exp(-2 * std::log(100.0) / (32 * 33));
  EXPECT_NEAR(paper_cost_between({2}, {4}), damping, 3e-4);
  EXPECT_NEAR(paper_cost_between({2}, {4}), paper_cost_between({4}, {2}), 1e-15);
}

}  // namespace
}  // namespace spherematch
