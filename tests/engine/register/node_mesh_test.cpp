#include "engine/register/node_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/sphere/grid.h"

namespace spherematch {
namespace {

using Eigen::Vector3d;

TEST(NodeMesh, FieldOfDerivativesIsTheGradient) {
  double previous = 1;
  for (const int subdivisions : {3, 4, 5}) {
    const NodeMesh mesh(subdivisions, 64);
    // Two functions, to see that they are kept apart: |p + c|^2 up to a constant, and x y.
    const Vector3d c(0.3, -0.7, 0.2);
    NodeMesh::Values values(mesh.count(), 2);
    values << mesh.nodes() * c, mesh.nodes().col(0).cwiseProduct(mesh.nodes().col(1));
    const NodeMesh::Values derivatives = mesh.derivatives(values);
    double worst = 0;
    for (int f = 0; f < 2; ++f) {
      Eigen::VectorXd u(2 * mesh.count());
      for (Eigen::Index i = 0; i < mesh.count(); ++i) u.segment<2>(2 * i) << derivatives(i, f), derivatives(i, 2 + f);
      const TangentGrid field = mesh.field(u);
      const Points centers = cell_centers(64);
      for (Eigen::Index i = 0; i < centers.rows(); ++i) {
        const Vector3d p = centers.row(i), gradient = f == 0 ? c : Vector3d(p.y(), p.x(), 0);
        const double colatitude = std::acos(p.z()), longitude = std::atan2(p.y(), p.x());
        const Vector3d down(std::cos(colatitude) * std::cos(longitude), std::cos(colatitude) * std::sin(longitude), -std::sin(colatitude));
        const Vector3d east(-std::sin(longitude), std::cos(longitude), 0);
        worst = std::max(
            {worst, std::abs(field.colatitude.data()[i] - gradient.dot(down)), std::abs(field.longitude.data()[i] - gradient.dot(east))});
      }
    }
    EXPECT_LT(worst, 0.6 * previous);
    previous = worst;
  }
  EXPECT_LT(previous, 0.01);
}

TEST(NodeMesh, AreasAddUpToTheFacesOnes) {
  const NodeMesh mesh(3, 16);
  double nodes = 0, faces = 0;
  for (Eigen::Index i = 0; i < mesh.count(); ++i) nodes += mesh.area(i);
  for (Eigen::Index f = 0; f < mesh.faces().rows(); ++f) {
    const Vector3d a = mesh.nodes().row(mesh.faces()(f, 0)), b = mesh.nodes().row(mesh.faces()(f, 1)),
                   c = mesh.nodes().row(mesh.faces()(f, 2));
    faces += (b - a).cross(c - a).norm() / 2;
  }
  EXPECT_NEAR(nodes, faces, 1e-12);
}

TEST(NodeMesh, SlotsAreWhereThePatternHasTheirEntries) {
  const NodeMesh mesh(2, 16);
  for (const Eigen::Index face : {Eigen::Index{0}, Eigen::Index{77}, mesh.faces().rows() - 1}) {
    Eigen::SparseMatrix<double> matrix = mesh.pattern();
    for (std::size_t slot = 0; slot < 21; ++slot) matrix.valuePtr()[mesh.face_slots(face)[slot]] = static_cast<double>(slot + 1);
    std::size_t slot = 0;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j <= i; ++j) {
        const int row = 2 * mesh.faces()(face, i / 2) + i % 2, column = 2 * mesh.faces()(face, j / 2) + j % 2;
        EXPECT_EQ(matrix.coeff(std::max(row, column), std::min(row, column)), static_cast<double>(++slot));
      }
  }
  Eigen::SparseMatrix<double> matrix = mesh.pattern();
  for (std::size_t slot = 0; slot < 3; ++slot) matrix.valuePtr()[mesh.node_slots(5)[slot]] = static_cast<double>(slot + 1);
  EXPECT_EQ(matrix.coeff(10, 10), 1);
  EXPECT_EQ(matrix.coeff(11, 10), 2);
  EXPECT_EQ(matrix.coeff(11, 11), 3);
}

}  // namespace
}  // namespace spherematch
