#include "engine/spectrum/hierarchy.h"

#include <gtest/gtest.h>

#include "engine/mesh/intrinsic_delaunay.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

Laplacian laplacian_of(const TriMesh& mesh) { return cotangent_laplacian(intrinsic_mesh(mesh), mesh.vertex_count()); }

Eigen::MatrixXd whole(const SparseMatrix& lower) { return Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>(); }

TEST(Hierarchy, MatricesAreTheGalerkinProducts) {
  const TriMesh mesh = test::creature(3);
  const Laplacian fine = laplacian_of(mesh);
  const auto levels = coarse_levels(mesh, fine, 60, 3, {});
  ASSERT_EQ(levels.size(), 2U);
  const Laplacian* finer = &fine;
  for (const CoarseLevel& level : levels) {
    const Eigen::MatrixXd prolong = level.interpolation;
    const Eigen::MatrixXd stiffness = prolong.transpose() * whole(finer->stiffness) * prolong;
    const Eigen::MatrixXd mass = prolong.transpose() * whole(finer->mass) * prolong;
    EXPECT_LT((whole(level.laplacian.stiffness) - stiffness).cwiseAbs().maxCoeff(), 1e-13 * stiffness.maxCoeff());
    EXPECT_LT((whole(level.laplacian.mass) - mass).cwiseAbs().maxCoeff(), 1e-13 * mass.maxCoeff());
    EXPECT_EQ(level.laplacian.stiffness.nonZeros(), level.laplacian.mass.nonZeros());
    EXPECT_LT((prolong.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-14);
    finer = &level.laplacian;
  }
  EXPECT_EQ(levels.back().laplacian.mass.rows(), 60);
}

TEST(Hierarchy, IsEmptyWhereTheMeshIsSmall) {
  const TriMesh mesh = test::icosphere(1);
  EXPECT_TRUE(coarse_levels(mesh, laplacian_of(mesh), 42, 4, {}).empty());
}

}  // namespace
}  // namespace spherematch
