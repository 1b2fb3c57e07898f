#include "engine/mesh/laplacian.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>

#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::icosphere;

constexpr double pi = std::numbers::pi;

/// The matrix from its lower triangle.
SparseMatrix full(const SparseMatrix& lower) { return lower.selfadjointView<Eigen::Lower>(); }

Laplacian laplacian_of(const TriMesh& mesh) { return cotangent_laplacian(intrinsic_mesh(mesh), mesh.vertex_count()); }

TriMesh unit_area(TriMesh mesh) {
  mesh.vertices /= std::sqrt(face_areas(mesh.vertices, mesh.faces).sum());
  return mesh;
}

TEST(StiffnessElement, HasTheCotangentsOfTheAngles) {
  // Right angle between sides of 3 and 4; opposite corners 0, 1, 2 lie 5, 4, 3. Cotangents: 0, 3/4, 4/3.
  const ElementMatrix e = stiffness_element({5, 4, 3}, 6);
  EXPECT_NEAR(e[3], 0, 1e-15);
  EXPECT_NEAR(e[4], -0.5 * 3 / 4, 1e-15);
  EXPECT_NEAR(e[5], -0.5 * 4 / 3, 1e-15);
  EXPECT_NEAR(e[0], 0.5 * (3.0 / 4 + 4.0 / 3), 1e-15);
  EXPECT_NEAR(e[1], 0.5 * 4 / 3, 1e-15);
  EXPECT_NEAR(e[2], 0.5 * 3 / 4, 1e-15);
  const ElementMatrix obtuse = stiffness_element({std::sqrt(3.0), 1, 1}, std::sqrt(3.0) / 4);
  EXPECT_NEAR(obtuse[3], 0.5 / std::sqrt(3.0), 1e-15) << "the cotangent of 120 degrees is negative";
}

TEST(MassElement, IntegratesProductsOfHatFunctions) {
  const ElementMatrix e = mass_element(12);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(e[k], 2);
    EXPECT_EQ(e[k + 3], 1);
  }
}

TEST(FaceAreas, AddUpAndAgreeWithVertexAreas) {
  const TriMesh mesh = test::creature(3);
  const Eigen::VectorXd areas = face_areas(mesh.vertices, mesh.faces), on_vertices = vertex_areas(mesh.vertices, mesh.faces);
  EXPECT_NEAR(areas.sum(), test::total_area(mesh), 1e-12);
  EXPECT_NEAR(on_vertices.sum(), areas.sum(), 1e-12);
  EXPECT_GT(on_vertices.minCoeff(), 0);
  EXPECT_DOUBLE_EQ(face_areas(test::tetrahedron().vertices, test::tetrahedron().faces)[0], 0.5);
}

TEST(CotangentLaplacian, AnnihilatesConstantsAtEveryScale) {
  for (const double scale : {1.0, 1e-8, 1e8}) {
    const TriMesh mesh = test::transformed(test::creature(3), scale, test::some_rotation(), scale * Eigen::Vector3d(1, 2, 3));
    const Laplacian laplacian = laplacian_of(mesh);
    const SparseMatrix stiffness = full(laplacian.stiffness), mass = full(laplacian.mass);
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(mesh.vertex_count());
    // Measured: 4e-16 of the largest diagonal entry.
    EXPECT_LT((stiffness * ones).cwiseAbs().maxCoeff(), 1e-14 * stiffness.diagonal().maxCoeff()) << scale;
    EXPECT_GT(stiffness.diagonal().minCoeff(), 0);
    const double area = test::total_area(mesh);
    EXPECT_NEAR(ones.dot(mass * ones), area, 1e-13 * area) << scale;
  }
}

TEST(CotangentLaplacian, ScalesAsItsIntegralsDo) {
  const TriMesh mesh = test::creature(2);
  const Laplacian small = laplacian_of(mesh), large = laplacian_of(test::transformed(mesh, 8, Eigen::Matrix3d::Identity(), {0, 0, 0}));
  EXPECT_LT((large.stiffness - small.stiffness).norm(), 1e-14 * small.stiffness.norm());
  EXPECT_LT((large.mass - 64 * small.mass).norm(), 1e-14 * large.mass.norm());
}

TEST(CotangentLaplacian, IsTheDirichletFormOfTheMesh) {
  const TriMesh mesh = test::creature(2);
  const Laplacian laplacian = laplacian_of(mesh);
  const SparseMatrix stiffness = full(laplacian.stiffness), mass = full(laplacian.mass);
  // The integral of |grad u|^2 over each triangle, u linear with the gradient found by solving for it.
  const Eigen::VectorXd u = mesh.vertices * Eigen::Vector3d(0.3, -1.2, 0.7) + mesh.vertices.col(0).cwiseProduct(mesh.vertices.col(1));
  double energy = 0, square = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const Eigen::Vector3d a = mesh.vertices.row(mesh.faces(f, 0)), b = mesh.vertices.row(mesh.faces(f, 1)),
                          c = mesh.vertices.row(mesh.faces(f, 2));
    const double ua = u[mesh.faces(f, 0)], ub = u[mesh.faces(f, 1)], uc = u[mesh.faces(f, 2)];
    Eigen::Matrix3d system;
    system << (b - a).transpose(), (c - a).transpose(), (b - a).cross(c - a).transpose();
    const Eigen::Vector3d gradient = system.inverse() * Eigen::Vector3d(ub - ua, uc - ua, 0);
    const double area = 0.5 * (b - a).cross(c - a).norm();
    energy += area * gradient.squaredNorm();
    // Edge midpoints integrate quadratics exactly.
    square += area / 3 * (std::pow((ua + ub) / 2, 2) + std::pow((ub + uc) / 2, 2) + std::pow((uc + ua) / 2, 2));
  }
  EXPECT_NEAR(u.dot(stiffness * u), energy, 1e-13 * energy);
  EXPECT_NEAR(u.dot(mass * u), square, 1e-13 * square);
}

TEST(CotangentLaplacian, HasTheCoordinatesOfTheUnitAreaSphereAsEigenfunctions) {
  double previous = 0;
  for (const int level : {3, 4}) {
    const TriMesh mesh = unit_area(icosphere(level));
    const Laplacian laplacian = laplacian_of(mesh);
    const SparseMatrix stiffness = full(laplacian.stiffness), mass = full(laplacian.mass);
    const Eigen::VectorXd x = mesh.vertices.col(0);
    const double error = std::abs(x.dot(stiffness * x) / x.dot(mass * x) / (8 * pi) - 1);
    if (previous > 0) {
      EXPECT_LT(error, previous / 3.5);
    }
    previous = error;

    // One step of the conformal flow at step size 0.4 therefore shrinks the sphere to 1 / (1 + 0.4 * 8 pi) = 0.0905.
    Eigen::SimplicialLDLT<SparseMatrix> solver(mass + 0.4 * stiffness);
    const Points shrunk = solver.solve(mass * mesh.vertices);
    const Eigen::VectorXd factors = shrunk.rowwise().norm().cwiseQuotient(mesh.vertices.rowwise().norm());
    // Measured: 0.09039 and 0.09045 for 0.09048, with a spread of 1.6e-4 and 5e-5.
    EXPECT_NEAR(factors.mean(), 1 / (1 + 0.4 * 8 * pi), 0.2 * error);
    EXPECT_LT(factors.maxCoeff() - factors.minCoeff(), 4e-4);
  }
  // Measured: 9.8e-4, 2.5e-4.
  EXPECT_LT(previous, 5e-4);
}

TEST(ElementAssembler, SumsTwoTriangulationsIntoOnePattern) {
  const TriMesh mesh = test::creature(2);
  IntrinsicMesh flipped = intrinsic_mesh(mesh);
  make_delaunay(flipped);
  ASSERT_NE((flipped.faces - mesh.faces).cwiseAbs().sum(), 0);
  const SparseMatrix pattern = edge_pattern({&mesh.faces, &flipped.faces}, mesh.vertex_count());
  EXPECT_GT(pattern.nonZeros(), edge_pattern({&mesh.faces}, mesh.vertex_count()).nonZeros());
  EXPECT_EQ(edge_pattern({&mesh.faces}, mesh.vertex_count()).nonZeros(), mesh.vertex_count() + mesh.face_count() * 3 / 2);
  EXPECT_EQ(pattern.norm(), 0);
  const Eigen::VectorXd areas = face_areas(flipped);
  const auto element = [&](Eigen::Index f) { return stiffness_element(flipped.lengths.row(f), areas[f]); };
  SparseMatrix matrix = pattern;
  const ElementAssembler assembler(pattern, flipped.faces);
  assembler.assemble(matrix, element);
  assembler.assemble(matrix, element);  // overwrites
  EXPECT_LT((matrix - cotangent_laplacian(flipped, mesh.vertex_count()).stiffness).norm(), 1e-14 * matrix.norm());
}

}  // namespace
}  // namespace spherematch
