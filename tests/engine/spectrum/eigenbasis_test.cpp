#include "engine/spectrum/eigenbasis.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
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

Laplacian laplacian_of(TriMesh mesh) {
  mesh.vertices.rowwise() -= mesh.vertices.colwise().mean().eval();
  mesh.vertices /= std::sqrt(face_areas(mesh.vertices, mesh.faces).sum());
  IntrinsicMesh intrinsic = intrinsic_mesh(mesh);
  make_delaunay(intrinsic);
  return cotangent_laplacian(intrinsic, mesh.vertex_count());
}

Eigenbasis basis_of(const TriMesh& mesh, int count) { return compute_eigenbasis(laplacian_of(mesh), count, {}); }

TEST(Eigenbasis, OfTheSphereHasItsEigenvaluesWithTheirMultiplicities) {
  std::vector<double> previous(7, 0);
  for (const int level : {3, 4}) {
    const Eigenbasis basis = basis_of(icosphere(level), 50);
    ASSERT_EQ(basis.values.size(), 50);
    EXPECT_NEAR(basis.values[0], 0, 1e-10);
    for (int l = 1; l <= 6; ++l) {
      const Eigen::VectorXd cluster = basis.values.segment(l * l, 2 * l + 1);
      const double exact = 4 * pi * l * (l + 1), error = (cluster.array() / exact - 1).abs().maxCoeff();
      // Linear elements approach from above, with an error of second order.
      EXPECT_GT(cluster.minCoeff(), exact);
      // Measured at l = 1 to 6: 0.00098 to 0.063 at level 3, a quarter of that at level 4.
      EXPECT_LT(error, level == 3 ? 0.09 : 0.025) << "l " << l;
      if (level == 4) {
        EXPECT_LT(error, previous[static_cast<std::size_t>(l)] / 3.5) << "l " << l;
      }
      previous[static_cast<std::size_t>(l)] = error;
    }
    EXPECT_GT(basis.values[49], 4 * pi * 7 * 7);
  }
}

void expect_eigenpairs(const Eigenbasis& basis, const Laplacian& laplacian) {
  const SparseMatrix stiffness = laplacian.stiffness.selfadjointView<Eigen::Lower>(), mass = laplacian.mass.selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd gram = basis.vectors.transpose() * mass * basis.vectors;
  // Measured: 4e-14.
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff(), 1e-12);
  double worst = 0;
  for (Eigen::Index i = 0; i < basis.values.size(); ++i) {
    const Eigen::VectorXd mv = mass * basis.vectors.col(i), residual = stiffness * basis.vectors.col(i) - basis.values[i] * mv;
    worst = std::max(worst, residual.norm() / ((1 + basis.values[i]) * mv.norm()));
    if (i > 0) {
      EXPECT_GE(basis.values[i], basis.values[i - 1]);
    }
  }
  // The solver's tolerance is 1e-9. Measured: 2e-11.
  EXPECT_LT(worst, 1e-9);
}

TEST(Eigenbasis, SolvesTheEigenproblemAndIsOrthonormal) {
  for (const TriMesh& mesh : {test::creature(3), icosphere(3)}) {
    const Laplacian laplacian = laplacian_of(mesh);
    const Eigenbasis basis = compute_eigenbasis(laplacian, 80, {});
    expect_eigenpairs(basis, laplacian);
    EXPECT_NEAR(basis.values[0], 0, 1e-10);
    EXPECT_LT((basis.vectors.col(0).array().abs() - 1).abs().maxCoeff(), 1e-10) << "the constant of the unit-area surface is one";
  }
}

TEST(Eigenbasis, FindsWhatADenseSolverFinds) {
  const TriMesh mesh = test::creature(2);
  const Laplacian laplacian = laplacian_of(mesh);
  const Eigen::MatrixXd stiffness = Eigen::MatrixXd(laplacian.stiffness).selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd mass = Eigen::MatrixXd(laplacian.mass).selfadjointView<Eigen::Lower>();
  const Eigen::VectorXd exact =
      Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness, mass, Eigen::EigenvaluesOnly).eigenvalues();
  for (const int count : {10, 60, 150}) {
    const Eigenbasis basis = compute_eigenbasis(laplacian, count, {});
    ASSERT_EQ(basis.values.size(), count);
    // Measured: 2e-14 of the largest.
    EXPECT_LT((basis.values - exact.head(count)).cwiseAbs().maxCoeff(), 1e-11 * exact[count]) << "a pair was missed";
  }
}

TEST(Eigenbasis, MissesNoneOfSeveralEqualEigenvalues) {
  // By Sylvester's law of inertia S - sigma M has as many negative pivots as there are eigenvalues below sigma.
  const TriMesh mesh = icosphere(3);
  const Laplacian laplacian = laplacian_of(mesh);
  for (const int count : {20, 30, 45, 49, 64, 100, 200}) {
    const Eigenbasis basis = compute_eigenbasis(laplacian, count, {});
    const double sigma = basis.values[count - 1] * (1 - 1e-7);
    const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower> factors(laplacian.stiffness - sigma * laplacian.mass);
    EXPECT_EQ((basis.values.array() < sigma).count(), (factors.vectorD().array() < 0).count()) << "of " << count << " pairs";
  }
}

TEST(Eigenbasis, AsksASmallMeshForNoMoreThanItHas) {
  for (const TriMesh& mesh : {test::tetrahedron(), icosphere(0), icosphere(1)}) {
    const Laplacian laplacian = laplacian_of(mesh);
    const Eigenbasis basis = compute_eigenbasis(laplacian, 200, {});
    EXPECT_EQ(basis.values.size(), mesh.vertex_count() - 2);
    EXPECT_EQ(basis.vectors.rows(), mesh.vertex_count());
    expect_eigenpairs(basis, laplacian);
  }
}

TEST(Eigenbasis, IsWhatSingleVectorsFind) {
  for (const TriMesh& mesh : {test::creature(4), icosphere(4)}) {
    const Laplacian laplacian = laplacian_of(mesh);
    const Eigenbasis blocks = compute_eigenbasis(laplacian, 100, {}), single = compute_eigenbasis_by_single_vectors(laplacian, 100, {});
    expect_eigenpairs(single, laplacian);
    EXPECT_LT((blocks.values - single.values).cwiseAbs().maxCoeff(), 1e-10 * single.values[99]);
    // Vectors of equal eigenvalues are free to turn among each other, and all to change sign; signatures are the same.
    const auto signatures = [](const Eigenbasis& basis) {
      return heat_kernel_signatures(basis.values.head(81), basis.vectors.leftCols(81).cast<float>(), {1, 0.0625});
    };
    EXPECT_LT((signatures(blocks) - signatures(single)).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(Eigenbasis, ReportsHowFarItIs) {
  double last = 0;
  int reports = 0;
  (void)compute_eigenbasis(laplacian_of(test::creature(3)), 50, {}, [&](double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    ++reports;
  });
  EXPECT_GT(reports, 5);
  EXPECT_GT(last, 0.7);
}

TEST(Eigenbasis, GivesTheSphereItsHeatKernelSignatures) {
  const Eigenbasis basis = basis_of(icosphere(4), 196);
  const Eigen::MatrixXd signatures = heat_kernel_signatures(basis.values, basis.vectors.cast<float>(), {0.01, 1.0 / 16, 1.0 / 8});
  const double exact[] = {8.29967, 1.66912, 1.13005};
  for (Eigen::Index t = 0; t < 3; ++t) {
    const double error = (signatures.col(t).array() / exact[t] - 1).abs().maxCoeff();
    // Discretisation: eigenvalues are too large. Measured: 3.5e-3, 3.3e-4, 8e-5.
    EXPECT_LT(error, t == 0 ? 7e-3 : (t == 1 ? 7e-4 : 2e-4));
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
  // Measured: 2e-14, 3e-14; but an entry may round to another float, which is a difference of 1e-7.
  EXPECT_LT((moved - reference).cwiseAbs().cwiseQuotient(reference).maxCoeff(), 1e-7);
  const std::vector<std::int32_t> order = test::shuffled(static_cast<std::int32_t>(mesh.vertex_count()), 5);
  const Eigen::MatrixXd renumbered = signatures(test::renumbered(mesh, order));
  double worst = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
    worst = std::max(worst, (renumbered.row(static_cast<Eigen::Index>(i)) - reference.row(order[i]))
                                .cwiseQuotient(reference.row(order[i]))
                                .cwiseAbs()
                                .maxCoeff());
  EXPECT_LT(worst, 1e-7);
}

TEST(Eigenbasis, IsDeterministicAndStopsWhenAsked) {
  const TriMesh mesh = test::creature(3);
  const Eigenbasis first = basis_of(mesh, 30), second = basis_of(mesh, 30);
  EXPECT_TRUE(first.values == second.values);
  EXPECT_TRUE(first.vectors == second.vectors);
  std::stop_source source;
  source.request_stop();
  const Progress progress{{}, source.get_token()};
  test::expect_refusal(ErrorCode::cancelled, [&] { (void)compute_eigenbasis(laplacian_of(mesh), 30, progress); });
}

}  // namespace
}  // namespace spherematch
