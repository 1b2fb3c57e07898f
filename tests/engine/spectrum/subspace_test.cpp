#include "engine/spectrum/subspace.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "engine/mesh/intrinsic_delaunay.h"
#include "engine/spectrum/eigenbasis.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

struct Problem {
  Laplacian laplacian;
  Pencil pencil;
  SparseMatrix stiffness, mass;

  explicit Problem(const Laplacian& l)
      : laplacian(l), pencil(l), stiffness(l.stiffness.selfadjointView<Eigen::Lower>()), mass(l.mass.selfadjointView<Eigen::Lower>()) {}
};

Problem sphere_problem(int level) {
  TriMesh mesh = test::icosphere(level);
  mesh.vertices /= std::sqrt(face_areas(mesh.vertices, mesh.faces).sum());
  return Problem(cotangent_laplacian(intrinsic_mesh(mesh), mesh.vertex_count()));
}

/// The lowest 64 pairs with `noise` of random values added to each vector.
Subspace disturbed(const Problem& problem, float noise) {
  const Eigenbasis exact = compute_eigenbasis(problem.laplacian, 64, {});
  std::srand(1);
  return {exact.vectors.cast<float>() + noise * Eigen::MatrixXf::Random(exact.vectors.rows(), 64), exact.values};
}

class SubspaceTest : public testing::Test {
 protected:
  Progress progress_;
  std::function<void(double)> report_;
  WorkMeter meter_{progress_, report_};
};

TEST_F(SubspaceTest, PencilMultipliesByBothMatrices) {
  const Problem problem = sphere_problem(3);
  const FloatBlock x = FloatBlock::Random(problem.mass.rows(), 48);
  FloatBlock stiffness(100, 48), mass(100, 48);
  problem.pencil.multiply(x, 30, 100, stiffness, mass);
  const Eigen::MatrixXd s = (problem.stiffness * x.cast<double>()).middleRows(30, 100),
                        m = (problem.mass * x.cast<double>()).middleRows(30, 100);
  EXPECT_LT((stiffness.cast<double>() - s).cwiseAbs().maxCoeff(), 1e-6 * s.cwiseAbs().maxCoeff());
  EXPECT_LT((mass.cast<double>() - m).cwiseAbs().maxCoeff(), 1e-6 * m.cwiseAbs().maxCoeff());
  const FloatBlock constant = FloatBlock::Constant(problem.mass.rows(), 48, 0.3F);
  problem.pencil.multiply(constant, 30, 100, stiffness, mass);
  EXPECT_EQ(stiffness.cwiseAbs().maxCoeff(), 0);
  EXPECT_NEAR(problem.pencil.highest_frequency(), 2, 1e-5) << "no negative weight on an icosphere";
}

TEST_F(SubspaceTest, InverseIterationKeepsEigenvectorsAndTakesNoiseAway) {
  const Problem problem = sphere_problem(4);
  Subspace subspace = disturbed(problem, 0.1F);
  const Eigen::VectorXd before = residuals(subspace, problem.pencil, 1, meter_);
  const FloatShiftInverse inverse(problem.laplacian, -10);
  iterate_inversely(subspace, problem.pencil, inverse, -10, 1, meter_);
  const Eigen::VectorXd after = residuals(subspace, problem.pencil, 1, meter_);
  // What of the noise is of low frequency stays for the projection. Measured: 0.18.
  EXPECT_LT((after.array() / before.array()).maxCoeff(), 0.3);
  const Eigen::VectorXd norms = (subspace.vectors.cast<double>().transpose() * problem.mass * subspace.vectors.cast<double>()).diagonal();
  EXPECT_LT((norms.array() - 1).abs().maxCoeff(), 0.02);
}

TEST_F(SubspaceTest, SmoothingTakesNoiseAway) {
  const Problem problem = sphere_problem(4);
  Subspace subspace = disturbed(problem, 0.1F);
  const Eigen::VectorXd before = residuals(subspace, problem.pencil, 1, meter_);
  smooth(subspace, problem.pencil, 8, 1.0 / 15, 1, meter_);
  EXPECT_LT((residuals(subspace, problem.pencil, 1, meter_).array() / before.array()).maxCoeff(), 0.05);
}

TEST_F(SubspaceTest, ProjectionFindsThePairsOfTheirSpan) {
  const Problem problem = sphere_problem(3);
  Subspace subspace = disturbed(problem, 0);
  const Eigen::VectorXd exact = subspace.values;
  std::srand(2);
  subspace.vectors = (subspace.vectors * Eigen::MatrixXf::Random(64, 64)).eval();
  subspace.values.setZero();
  ASSERT_TRUE(orthonormalize(subspace, problem.pencil, 1, meter_));
  const auto gram = [&] { return (subspace.vectors.cast<double>().transpose() * problem.mass * subspace.vectors.cast<double>()).eval(); };
  // A random matrix has a condition of some hundreds, which single precision shows.
  EXPECT_LT((gram() - Eigen::MatrixXd::Identity(64, 64)).cwiseAbs().maxCoeff(), 1e-3);
  ASSERT_TRUE(project(subspace, problem.pencil, 1, meter_));
  EXPECT_LT((gram() - Eigen::MatrixXd::Identity(64, 64)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((subspace.values - exact).cwiseAbs().maxCoeff(), 1e-4 * exact[63]);
}

TEST_F(SubspaceTest, DependentColumnsAreNoticed) {
  const Problem problem = sphere_problem(3);
  Subspace subspace = disturbed(problem, 0);
  subspace.vectors.col(40) = subspace.vectors.col(3);
  const FloatBlock before = subspace.vectors;
  EXPECT_FALSE(orthonormalize(subspace, problem.pencil, 1, meter_));
  EXPECT_FALSE(project(subspace, problem.pencil, 1, meter_));
  EXPECT_TRUE(subspace.vectors == before);
}

}  // namespace
}  // namespace spherematch
