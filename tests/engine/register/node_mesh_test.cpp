#include "engine/register/node_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace spherematch {
namespace {

using Eigen::Vector3d;

TEST(NodeMesh, DerivativesAreTheGradient) {
  double previous = 1;
  for (const int subdivisions : {3, 4, 5}) {
    const NodeMesh mesh(subdivisions);
    // Nodes that have moved, evenly and unevenly.
    Points places = mesh.nodes();
    for (Eigen::Index i = 0; i < places.rows(); ++i) places.row(i) = (places.row(i) + 0.2 * places.row(i).cwiseAbs2()).normalized();
    // Two functions, to see that they are kept apart: |p + c|^2 up to a constant, and x y.
    const Vector3d c(0.3, -0.7, 0.2);
    PointValues values(mesh.count(), 2), derivatives(mesh.count(), 4);
    values << (places * c).cast<float>(), places.col(0).cwiseProduct(places.col(1)).cast<float>();
    std::vector<TangentFrame> frames;
    for (Eigen::Index i = 0; i < places.rows(); ++i) frames.push_back(tangent_frame(places.row(i)));
    mesh.differentiate(values, places, frames, 0, 100, derivatives);
    mesh.differentiate(values, places, frames, 100, mesh.count(), derivatives);
    double worst = 0;
    for (Eigen::Index i = 0; i < places.rows(); ++i)
      for (int f = 0; f < 2; ++f) {
        const Vector3d gradient = f == 0 ? c : Vector3d(places(i, 1), places(i, 0), 0);
        const Eigen::Vector2f expected = (frames[static_cast<std::size_t>(i)].transpose() * gradient).cast<float>();
        const Eigen::Vector2f error = expected - Eigen::Vector2f(derivatives(i, f), derivatives(i, 2 + f));
        worst = std::max<double>(worst, error.cwiseAbs().maxCoeff());
      }
    EXPECT_LT(worst, 0.6 * previous);
    previous = worst;
  }
  EXPECT_LT(previous, 0.02);
}

TEST(NodeMesh, FramesAreOrthonormalTangents) {
  for (const Vector3d& p : {Vector3d(0, 0, 1), Vector3d(1, 0, 0), Vector3d(0.6, 0, -0.8)}) {
    Eigen::Matrix3d basis;
    basis << tangent_frame(p), p;
    EXPECT_LT((basis.transpose() * basis - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  }
}

TEST(NodeMesh, ParentsAreTheEndsOfTheEdgeThatANodeIsInTheMiddleOf) {
  const NodeMesh coarse(2), fine(3);
  for (Eigen::Index i = 0; i < fine.count(); ++i) {
    const auto& [a, b] = fine.parents(i);
    ASSERT_LT(std::max<Eigen::Index>(a, b), coarse.count());
    EXPECT_EQ(a == b, i < coarse.count());
    EXPECT_LT(((coarse.nodes().row(a) + coarse.nodes().row(b)).normalized() - fine.nodes().row(i)).norm(), 1e-14);
  }
}

TEST(NodeMesh, AreasAddUpToTheFacesOnes) {
  const NodeMesh mesh(3);
  double faces = 0;
  for (Eigen::Index f = 0; f < mesh.faces().rows(); ++f) {
    const Vector3d a = mesh.nodes().row(mesh.faces()(f, 0)), b = mesh.nodes().row(mesh.faces()(f, 1)),
                   c = mesh.nodes().row(mesh.faces()(f, 2));
    faces += (b - a).cross(c - a).norm() / 2;
  }
  EXPECT_NEAR(mesh.areas().sum(), faces, 1e-12);
}

TEST(NodeMesh, SlotsAreWhereThePatternHasTheirBlocks) {
  const NodeMesh mesh(2);
  const BlockPattern& pattern = mesh.pattern();
  ASSERT_EQ(pattern.start.size(), static_cast<std::size_t>(mesh.count()) + 1);
  // A node and its neighbours: each edge twice.
  EXPECT_EQ(pattern.column.size(), static_cast<std::size_t>(mesh.count() + 3 * mesh.faces().rows()));
  const auto row_of = [&](std::int32_t slot) {
    return static_cast<std::int32_t>(std::upper_bound(pattern.start.begin(), pattern.start.end(), slot) - pattern.start.begin()) - 1;
  };
  for (Eigen::Index face = 0; face < mesh.faces().rows(); ++face)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const std::int32_t slot = mesh.face_slots(face)[3 * i + j];
        EXPECT_EQ(row_of(slot), mesh.faces()(face, static_cast<Eigen::Index>(i)));
        EXPECT_EQ(pattern.column[static_cast<std::size_t>(slot)], mesh.faces()(face, static_cast<Eigen::Index>(j)));
      }
  EXPECT_EQ(row_of(mesh.node_slot(5)), 5);
  EXPECT_EQ(pattern.column[static_cast<std::size_t>(mesh.node_slot(5))], 5);
}

}  // namespace
}  // namespace spherematch
