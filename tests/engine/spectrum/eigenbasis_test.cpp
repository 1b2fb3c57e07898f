#include "engine/spectrum/eigenbasis.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/mesh/laplacian.h"
#include "engine/spectrum/signatures.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::icosphere;

constexpr double pi = std::numbers::pi;

IntrinsicMesh unit_area(TriMesh mesh) {
  mesh.vertices.rowwise() -= mesh.vertices.colwise().mean().eval();
  mesh.vertices /= std::sqrt(face_areas(mesh.vertices, mesh.faces).sum());
  IntrinsicMesh intrinsic = intrinsic_mesh(mesh);
  make_delaunay(intrinsic);
  return intrinsic;
}

Eigenbasis basis_of(const TriMesh& mesh, int count) { return compute_eigenbasis(unit_area(mesh), mesh.vertex_count(), count, {}); }

TEST(Eigenbasis, OfTheSphereHasItsEigenvaluesWithTheirMultiplicities) {
  std::vector<double> previous(7, 0);
  for (const int level : {3, 4}) {
    const Eigenbasis basis = basis_of(icosphere(level), 50);
    ASSERT_EQ(basis.values.size(), 50);
    EXPECT_NEAR(basis.values[0], 0, 1e-8);
    for (int l = 1; l <= 6; ++l) {
      const Eigen::VectorXd cluster = basis.values.segment(l * l, 2 * l + 1);
      const double exact = 4 * pi * l * (l + 1), error = (cluster.array() / exact - 1).abs().maxCoeff();
      std::printf("level %d l %d error %g\n", level, l, error);
      // Linear elements approach from above, with an error of second order.
      EXPECT_GT(cluster.minCoeff(), exact);
      EXPECT_LT(error, level == 3 ? 0.09 : 0.025) << "l " << l;
      if (level == 4) { EXPECT_LT(error, previous[static_cast<std::size_t>(l)] / 3.5) << "l " << l; }
      previous[static_cast<std::size_t>(l)] = error;
    }
    EXPECT_GT(basis.values[49], 4 * pi * 7 * 7);
  }
}

/// M-norms of S v / lambda - M v in the dual norm's simplest stand-in, relative to |M v|.
void expect_eigenpairs(const Eigenbasis& basis, const IntrinsicMesh& mesh, Eigen::Index vertices) {
  const Laplacian laplacian = cotangent_laplacian(mesh, vertices);
  const SparseMatrix stiffness = laplacian.stiffness.selfadjointView<Eigen::Lower>(), mass = laplacian.mass.selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd gram = basis.vectors.transpose() * mass * basis.vectors;
  std::printf("gram %g\n", (gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff());
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff(), 1e-9);
  double worst = 0;
  for (Eigen::Index i = 0; i < basis.values.size(); ++i) {
    const Eigen::VectorXd mv = mass * basis.vectors.col(i), residual = stiffness * basis.vectors.col(i) - basis.values[i] * mv;
    worst = std::max(worst, residual.norm() / ((1 + basis.values[i]) * mv.norm()));
    if (i > 0) { EXPECT_GE(basis.values[i], basis.values[i - 1]); }
  }
  std::printf("residual %g\n", worst);
  EXPECT_LT(worst, 1e-7);
}

TEST(Eigenbasis, SolvesTheEigenproblemAndIsOrthonormal) {
  for (const TriMesh& mesh : {test::creature(3), icosphere(3)}) {
    const IntrinsicMesh intrinsic = unit_area(mesh);
    const Eigenbasis basis = compute_eigenbasis(intrinsic, mesh.vertex_count(), 80, {});
    expect_eigenpairs(basis, intrinsic, mesh.vertex_count());
    EXPECT_NEAR(basis.values[0], 0, 1e-8);
    EXPECT_LT((basis.vectors.col(0).array().abs() - 1).abs().maxCoeff(), 1e-8) << "the constant of the unit-area surface is one";
  }
}

TEST(Eigenbasis, FindsWhatADenseSolverFinds) {
  const TriMesh mesh = test::creature(2);
  const IntrinsicMesh intrinsic = unit_area(mesh);
  const Laplacian laplacian = cotangent_laplacian(intrinsic, mesh.vertex_count());
  const Eigen::MatrixXd stiffness = Eigen::MatrixXd(laplacian.stiffness).selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd mass = Eigen::MatrixXd(laplacian.mass).selfadjointView<Eigen::Lower>();
  const Eigen::VectorXd exact = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness, mass, Eigen::EigenvaluesOnly).eigenvalues();
  for (const int count : {10, 60, 150}) {
    const Eigenbasis basis = compute_eigenbasis(intrinsic, mesh.vertex_count(), count, {});
    ASSERT_EQ(basis.values.size(), count);
    EXPECT_LT((basis.values - exact.head(count)).cwiseAbs().maxCoeff(), 1e-7 * exact[count]) << "a pair was missed";
  }
}

TEST(Eigenbasis, AsksASmallMeshForNoMoreThanItHas) {
  for (const TriMesh& mesh : {test::tetrahedron(), icosphere(0), icosphere(1)}) {
    const IntrinsicMesh intrinsic = unit_area(mesh);
    const Eigenbasis basis = compute_eigenbasis(intrinsic, mesh.vertex_count(), 200, {});
    EXPECT_EQ(basis.values.size(), mesh.vertex_count() - 2);
    EXPECT_EQ(basis.vectors.rows(), mesh.vertex_count());
    expect_eigenpairs(basis, intrinsic, mesh.vertex_count());
  }
}

TEST(Eigenbasis, GivesTheSphereItsHeatKernelSignatures) {
  const Eigenbasis basis = basis_of(icosphere(4), 196);
  const Eigen::MatrixXd signatures = heat_kernel_signatures(basis.values, basis.vectors.cast<float>(), {0.01, 1.0 / 16, 1.0 / 8});
  const double exact[] = {8.29967, 1.66912, 1.13005};
  for (Eigen::Index t = 0; t < 3; ++t) {
    const double error = (signatures.col(t).array() / exact[t] - 1).abs().maxCoeff();
    std::printf("hks %g: %g\n", exact[t], error);
    EXPECT_LT(error, 0.01);
  }
}

TEST(Eigenbasis, SignaturesDoNotDependOnPlaceSizeTurnAndNumbering) {
  const TriMesh mesh = test::creature(3);
  const std::vector<double> times{1, 0.125, 0.01};
  const auto signatures = [&](const TriMesh& m) {
    const Eigenbasis basis = basis_of(m, 100);
    return heat_kernel_signatures(basis.values, basis.vectors.cast<float>(), times);
  };
  const Eigen::MatrixXd reference = signatures(mesh);
  const Eigen::MatrixXd moved = signatures(test::transformed(mesh, 170, test::some_rotation(), {900, -40, 300}));
  std::printf("moved %g\n", (moved - reference).cwiseAbs().cwiseQuotient(reference).maxCoeff());
  EXPECT_LT((moved - reference).cwiseAbs().cwiseQuotient(reference).maxCoeff(), 1e-6);
  const std::vector<std::int32_t> order = test::shuffled(static_cast<std::int32_t>(mesh.vertex_count()), 5);
  const Eigen::MatrixXd renumbered = signatures(test::renumbered(mesh, order));
  double worst = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
    worst = std::max(worst, (renumbered.row(static_cast<Eigen::Index>(i)) - reference.row(order[i])).cwiseQuotient(reference.row(order[i])).cwiseAbs().maxCoeff());
  std::printf("renumbered %g\n", worst);
  EXPECT_LT(worst, 1e-6);
}

TEST(Eigenbasis, IsDeterministicAndStopsWhenAsked) {
  const TriMesh mesh = test::creature(3);
  const Eigenbasis first = basis_of(mesh, 30), second = basis_of(mesh, 30);
  EXPECT_TRUE(first.values == second.values);
  EXPECT_TRUE(first.vectors == second.vectors);
  std::stop_source source;
  source.request_stop();
  const Progress progress{{}, source.get_token()};
  test::expect_refusal(ErrorCode::cancelled, [&] { (void)compute_eigenbasis(unit_area(mesh), mesh.vertex_count(), 30, progress); });
}

}  // namespace
}  // namespace spherematch
