#include "engine/register/selection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "engine/mesh/intrinsic_delaunay.h"
#include "engine/mesh/laplacian.h"
#include "engine/register/composition.h"
#include "engine/spectrum/eigenbasis.h"
#include "tests/engine/sphere/spheres.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

/// The parts of a prepared shape that selection reads.
PreprocessedShape shape_of(TriMesh mesh) {
  mesh.vertices /= std::sqrt(face_areas(mesh.vertices, mesh.faces).sum());
  PreprocessedShape shape;
  IntrinsicMesh intrinsic = intrinsic_mesh(mesh);
  make_delaunay(intrinsic);
  const Eigenbasis basis = compute_eigenbasis(cotangent_laplacian(intrinsic, mesh.vertex_count()), 60, {});
  shape.eigenvalues = basis.values;
  shape.eigenvectors = basis.vectors.cast<float>();
  shape.sphere = mesh.vertices.rowwise().normalized();
  shape.surface.mesh = mesh;
  return shape;
}

Eigen::VectorXd weights_of(const TriMesh& mesh) {
  const Eigen::VectorXd areas = vertex_areas(mesh.vertices, mesh.faces);
  return areas / areas.sum();
}

TEST(SelectionSignals, TellTheEndsOfABodyApart) {
  const PreprocessedShape shape = shape_of(test::creature(3));
  const Eigen::MatrixXd signals = selection_signals(shape);
  ASSERT_EQ(signals.rows(), shape.surface.mesh.vertex_count());
  ASSERT_GE(signals.cols(), 1);
  EXPECT_TRUE(signals.allFinite());
  const Triangles& faces = shape.surface.mesh.faces;
  const Eigen::VectorXd weights = weights_of(shape.surface.mesh);
  const auto cost = [&](const Eigen::Matrix3d& turn) {
    const Points turned = test::rotated(shape.sphere, turn);
    return registration_cost(signals, weights, signals, faces, locate_all(turned, PointLocation(shape.sphere, faces)));
  };
  EXPECT_EQ(cost(Eigen::Matrix3d::Identity()), 0);
  const double slightly = cost(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX()).toRotationMatrix());
  EXPECT_GT(slightly, 0);
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)})
    EXPECT_GT(cost(Eigen::AngleAxisd(std::numbers::pi, axis).toRotationMatrix()), 2 * slightly);
}

TEST(RegistrationCost, IsTheWeightedDifferenceAtTheImage) {
  Triangles faces(1, 3);
  faces << 2, 0, 1;
  Eigen::MatrixXd source(2, 2), target(3, 2);
  source << 1, 10, 2, 20;
  target << 0, 8, 4, 16, 2, 4;
  const std::vector<Location> locations{{0, {0.5, 0.25, 0.25}}, {0, {0, 0, 1}}};
  // Images: 0.5 (2, 4) + 0.25 (0, 8) + 0.25 (4, 16) = (2, 8), and (4, 16).
  const double cost = registration_cost(source, Eigen::Vector2d(0.25, 0.75), target, faces, locations);
  EXPECT_NEAR(cost, 0.25 * (1 + 2) / 2 + 0.75 * (2 + 4) / 2, 1e-14);
}

TEST(PaperCost, OfKnownFunctionsIsTheirMeanDifference) {
  const TriMesh mesh = test::icosphere(4);
  const auto cost = [&](const Eigen::VectorXd& f, const Eigen::VectorXd& g) {
    return paper_cost(mesh.vertices, mesh.faces, f, mesh.vertices, mesh.faces, g, 64);
  };
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(mesh.vertex_count()), x = mesh.vertices.col(0), z = mesh.vertices.col(2);
  EXPECT_EQ(cost(z, z), 0);
  EXPECT_NEAR(cost(3 * ones, ones), 2, 1e-12);
  // The mean of |2 x| over the sphere is one; degree one is damped by exp(-2 tau), tau = ln(100) / (32 * 33).
  const double damping = std::exp(-2 * std::log(100.0) / (32 * 33));
  // Measured: 8e-4.
  EXPECT_NEAR(cost(x, -x), damping, 1.6e-3);
  EXPECT_NEAR(cost(z, -z), damping, 1.6e-3);
  EXPECT_NEAR(cost(z, -z), cost(-z, z), 1e-15);
}

}  // namespace
}  // namespace spherematch
