#include "engine/spectrum/curvature.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/mesh/laplacian.h"
#include "engine/spectrum/eigenbasis.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

TriMesh unit_area(TriMesh mesh) {
  mesh.vertices /= std::sqrt(face_areas(mesh.vertices, mesh.faces).sum());
  return mesh;
}

Eigen::VectorXd curvature(const TriMesh& mesh, double time) {
  PreprocessParameters parameters;
  parameters.eigenpairs = 100;
  const FloatEigenbasis basis = surface_eigenbasis(mesh, parameters, 1, {});
  return smoothed_mean_curvature(mesh, basis.values, basis.vectors, time);
}

/// A sphere with its point at `axis` pulled outward or pushed inward.
TriMesh bumpy_sphere(double height) {
  TriMesh mesh = test::icosphere(4);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v)
    mesh.vertices.row(v) *= 1 + height * std::exp(-6 * (1 - mesh.vertices.row(v).normalized().z()));
  return unit_area(mesh);
}

Eigen::Index top(const TriMesh& mesh) {
  Eigen::Index best = 0;
  mesh.vertices.rowwise().normalized().col(2).maxCoeff(&best);
  return best;
}

TEST(SmoothedMeanCurvature, OfASphereIsTheSameEverywhere) {
  const Eigen::VectorXd values = curvature(unit_area(test::icosphere(4)), 0.01);
  EXPECT_LT((values.array() - 1).abs().maxCoeff(), 0.01);
}

TEST(SmoothedMeanCurvature, IsOfUnitRootMeanSquare) {
  const TriMesh mesh = unit_area(test::creature(4));
  const Eigen::VectorXd areas = vertex_areas(mesh.vertices, mesh.faces);
  EXPECT_NEAR(curvature(mesh, 0.01).cwiseAbs2().dot(areas) / areas.sum(), 1, 1e-6);
}

TEST(SmoothedMeanCurvature, TellsABulgeFromADent) {
  const TriMesh bulge = bumpy_sphere(0.4), dent = bumpy_sphere(-0.4);
  EXPECT_GT(curvature(bulge, 0.003)[top(bulge)], 1.3);
  EXPECT_LT(curvature(dent, 0.003)[top(dent)], 0);
  // Smoothing takes off the bulge.
  EXPECT_LT(curvature(bulge, 0.03)[top(bulge)], curvature(bulge, 0.003)[top(bulge)]);
}

TEST(SmoothedMeanCurvature, DependsOnTheShapeAlone) {
  const TriMesh mesh = unit_area(test::creature(4));
  const Eigen::VectorXd plain = curvature(mesh, 0.01);
  EXPECT_LT((curvature(test::transformed(mesh, 1, test::some_rotation(), {0.1, 0.2, 0.3}), 0.01) - plain).cwiseAbs().maxCoeff(), 0.02);
  TriMesh mirrored = mesh;
  mirrored.vertices.col(0) *= -1;
  mirrored.faces.col(1).swap(mirrored.faces.col(2));
  EXPECT_LT((curvature(mirrored, 0.01) - plain).cwiseAbs().maxCoeff(), 0.02);
}

}  // namespace
}  // namespace spherematch
