#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/mesh/laplacian.h"
#include "engine/spectrum/eigenbasis.h"
#include "engine/spectrum/signatures.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

TriMesh unit_area(TriMesh mesh) {
  mesh.vertices.rowwise() -= mesh.vertices.colwise().mean().eval();
  mesh.vertices /= std::sqrt(face_areas(mesh.vertices, mesh.faces).sum());
  return mesh;
}

Laplacian laplacian_of(const TriMesh& mesh) {
  IntrinsicMesh intrinsic = intrinsic_mesh(mesh);
  make_delaunay(intrinsic);
  return cotangent_laplacian(intrinsic, mesh.vertex_count());
}

/// Two balls joined by a thin neck.
TriMesh dumbbell(int subdivisions) {
  TriMesh mesh = test::icosphere(subdivisions);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v)
    mesh.vertices.row(v).tail<2>() *= 0.06 + 0.94 * std::clamp(1.6 * std::abs(mesh.vertices(v, 0)) - 0.5, 0.0, 1.0);
  return mesh;
}

FloatEigenbasis in_single_precision(const Eigenbasis& basis) { return {basis.values, basis.vectors.cast<float>()}; }

Eigen::MatrixXd signatures(const FloatEigenbasis& basis, const std::vector<double>& times) {
  return heat_kernel_signatures(basis.values, basis.vectors, times);
}

/// Sines of the angles between the exact vectors and the span of the found ones.
Eigen::ArrayXd angles(const FloatEigenbasis& found, const Eigenbasis& exact, const Laplacian& laplacian) {
  const SparseMatrix mass = laplacian.mass.selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd products = (mass * found.vectors.cast<double>()).transpose() * exact.vectors;
  return (1 - products.colwise().squaredNorm().transpose().array()).max(0).sqrt();
}

/// What eigenbasis.h promises, against the same pairs by block Lanczos.
void expect_contract(const FloatEigenbasis& found, const Eigenbasis& exact, const Laplacian& laplacian) {
  const Eigen::Index count = exact.values.size(), half = count / 2;
  ASSERT_EQ(found.values.size(), count);
  ASSERT_EQ(found.vectors.rows(), exact.vectors.rows());
  EXPECT_NEAR(found.values[0], 0, 1e-6);
  const Eigen::ArrayXd errors =
      (found.values.tail(count - 1) - exact.values.tail(count - 1)).array() / exact.values.tail(count - 1).array();
  EXPECT_GT(errors.minCoeff(), -2e-6) << "projections are not below";
  EXPECT_LT(errors.head(half).maxCoeff(), 1e-4);
  EXPECT_LT(errors.maxCoeff(), 5e-3);
  EXPECT_LT(angles(found, exact, laplacian).head(half).maxCoeff(), 0.03);

  const SparseMatrix mass = laplacian.mass.selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd vectors = found.vectors.cast<double>(), gram = vectors.transpose() * mass * vectors;
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff(), 2e-6);

  const std::vector<double> times{1, 0.25, 0.0625, 0.01, 0.003};
  const Eigen::MatrixXd ours = signatures(found, times), theirs = signatures(in_single_precision(exact), times);
  const double most[] = {1e-5, 1e-4, 1e-4, 1e-3, 1e-2};
  for (Eigen::Index t = 0; t < ours.cols(); ++t)
    EXPECT_LT((ours.col(t) - theirs.col(t)).cwiseAbs().maxCoeff(), most[t] * theirs.col(t).maxCoeff())
        << "t = " << times[static_cast<std::size_t>(t)];
}

TEST(MultilevelEigenbasis, FindsWhatBlockLanczosFinds) {
  // The icosphere has clusters of up to 27 equal eigenvalues; one of them is cut by the last pair.
  for (const TriMesh& body : {test::creature(4), test::icosphere(4), dumbbell(5)}) {
    const TriMesh mesh = unit_area(body);
    const Laplacian laplacian = laplacian_of(mesh);
    const auto found = compute_eigenbasis_by_levels(mesh, laplacian, 200, 1, {});
    ASSERT_TRUE(found.has_value());
    expect_contract(*found, compute_eigenbasis(laplacian, 200, {}), laplacian);
  }
}

TEST(MultilevelEigenbasis, FindsFewPairsAndMany) {
  const TriMesh mesh = unit_area(test::creature(4));
  const Laplacian laplacian = laplacian_of(mesh);
  for (const int count : {10, 77, 400}) {
    const auto found = compute_eigenbasis_by_levels(mesh, laplacian, count, 1, {});
    ASSERT_TRUE(found.has_value()) << count;
    const Eigenbasis exact = compute_eigenbasis(laplacian, count, {});
    ASSERT_EQ(found->values.size(), count);
    EXPECT_LT(((found->values - exact.values).array() / (1 + exact.values.array())).abs().maxCoeff(), 5e-3) << count;
  }
}

TEST(MultilevelEigenbasis, OfTheSphereHasItsMultiplicities) {
  const TriMesh mesh = unit_area(test::icosphere(5));
  const auto found = compute_eigenbasis_by_levels(mesh, laplacian_of(mesh), 200, 1, {});
  ASSERT_TRUE(found.has_value());
  for (int l = 1; l <= 13; ++l) {
    const Eigen::VectorXd cluster = found->values.segment(l * l, std::min(2 * l + 1, 200 - l * l));
    const double exact = 4 * std::numbers::pi * l * (l + 1);
    EXPECT_GT(cluster.minCoeff(), exact * (1 - 1e-6)) << "l " << l;
    // Discretisation, of second order, and at the top what the solver leaves.
    EXPECT_LT(cluster.maxCoeff(), exact * (1 + 1.5e-4 * l * l)) << "l " << l;
  }
}

TEST(MultilevelEigenbasis, SmoothsWhatItDoesNotFactorize) {
  const TriMesh mesh = unit_area(test::creature(5));
  const Laplacian laplacian = laplacian_of(mesh);
  const auto found = compute_eigenbasis_by_levels(mesh, laplacian, 200, 1, {}, {}, 5000);
  ASSERT_TRUE(found.has_value());
  expect_contract(*found, compute_eigenbasis(laplacian, 200, {}), laplacian);
}

TEST(MultilevelEigenbasis, LeavesSmallMeshesAlone) {
  for (const TriMesh& mesh : {test::tetrahedron(), test::icosphere(0), test::icosphere(2)})
    EXPECT_FALSE(compute_eigenbasis_by_levels(unit_area(mesh), laplacian_of(unit_area(mesh)), 200, 1, {}).has_value());
}

TEST(MultilevelEigenbasis, DoesNotDependOnTheThreads) {
  const TriMesh mesh = unit_area(test::creature(4));
  const Laplacian laplacian = laplacian_of(mesh);
  const auto one = compute_eigenbasis_by_levels(mesh, laplacian, 100, 1, {});
  ASSERT_TRUE(one.has_value());
  for (const int threads : {1, 2, 3}) {
    const auto other = compute_eigenbasis_by_levels(mesh, laplacian, 100, threads, {});
    ASSERT_TRUE(other.has_value());
    EXPECT_TRUE(one->values == other->values) << threads;
    EXPECT_TRUE(one->vectors == other->vectors) << threads;
  }
}

TEST(MultilevelEigenbasis, ReportsAndStops) {
  const TriMesh mesh = unit_area(test::creature(4));
  const Laplacian laplacian = laplacian_of(mesh);
  double last = 0;
  int reports = 0;
  std::stop_source source;
  const Progress progress{{}, source.get_token()};
  const auto report = [&](double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    ++reports;
  };
  EXPECT_TRUE(compute_eigenbasis_by_levels(mesh, laplacian, 100, 1, progress, report).has_value());
  EXPECT_GT(reports, 20);
  EXPECT_GT(last, 0.9);
  test::expect_refusal(ErrorCode::cancelled, [&] {
    (void)compute_eigenbasis_by_levels(mesh, laplacian, 100, 2, progress, [&](double fraction) {
      if (fraction > 0.3) source.request_stop();
    });
  });
}

TEST(SurfaceEigenbasis, IsThatOfTheSolverAskedFor) {
  const TriMesh mesh = unit_area(test::creature(4));
  const Laplacian laplacian = laplacian_of(mesh);
  const Eigenbasis exact = compute_eigenbasis(laplacian, 100, {});
  PreprocessParameters parameters;
  parameters.eigenpairs = 100;
  expect_contract(surface_eigenbasis(mesh, parameters, 1, {}), exact, laplacian);
  parameters.multilevel_eigenbasis = false;
  for (const bool single : {false, true}) {
    parameters.single_vector_lanczos = single;
    const FloatEigenbasis basis = surface_eigenbasis(mesh, parameters, 1, {});
    EXPECT_LT((basis.values - exact.values).cwiseAbs().maxCoeff(), 1e-10 * exact.values[99]);
    EXPECT_LT(angles(basis, exact, laplacian).head(99).maxCoeff(), 1e-3);
  }
}

TEST(SurfaceEigenbasis, TakesNeedlesAndSmallMeshes) {
  // Triangles thirty times as long as wide, which do not coarsen well.
  for (const TriMesh& body :
       {test::ellipsoid(4, {1, 0.03, 0.03}), test::ellipsoid(4, {1, 1, 1e-4}), test::icosphere(1), test::tetrahedron()}) {
    const TriMesh mesh = unit_area(body);
    const Laplacian laplacian = laplacian_of(mesh);
    const FloatEigenbasis basis = surface_eigenbasis(mesh, {}, 1, {});
    const Eigenbasis exact = compute_eigenbasis(laplacian, 200, {});
    ASSERT_EQ(basis.values.size(), exact.values.size());
    EXPECT_LT(((basis.values - exact.values).array() / (1 + exact.values.array())).abs().maxCoeff(), 5e-3);
  }
}

}  // namespace
}  // namespace spherematch
