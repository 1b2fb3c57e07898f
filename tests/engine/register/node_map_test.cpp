#include "engine/register/node_map.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "engine/sphere/orientation.h"
#include "tests/engine/sphere/spheres.h"

namespace spherematch {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const GridSamples& no_signals() {
  static const GridSamples samples({Grid::Zero(8, 8)});
  return samples;
}

NodeMap turned_map(const NodeMesh& mesh, const Matrix3d& source, const Matrix3d& target) {
  const std::vector<Eigen::Index> none;
  return NodeMap(mesh, GridFlowSide(no_signals(), none, source, 64), GridFlowSide(no_signals(), none, target, 64));
}

/// Places that are moved by up to a fifth of an edge.
Points shaken(const Points& places, double by, std::uint64_t seed) {
  test::Random random(seed);
  Points result = places;
  for (Eigen::Index i = 0; i < result.rows(); ++i) result.row(i) = (result.row(i) + by * random.unit_vector().transpose()).normalized();
  return result;
}

Points some_points(int count) {
  test::Random random(5);
  Points result(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) result.row(i) = random.unit_vector();
  return result;
}

TEST(NodeMap, OfTwoTurnedSidesIsTheRotationBetweenThem) {
  const NodeMesh mesh(4);
  const Matrix3d s = test::Random(1).rotation(), t = test::Random(2).rotation();
  const NodeMap map = turned_map(mesh, s, t);
  EXPECT_TRUE(map.bijective());
  const Points points = some_points(200);
  // Origins are interpolated on 64 x 64 cells.
  EXPECT_LT((map.forward(points) - points * (t.transpose() * s).transpose()).rowwise().norm().maxCoeff(), 1e-3);
}

TEST(NodeMap, BackwardUndoesForward) {
  const NodeMesh mesh(4);
  NodeMap map = turned_map(mesh, Matrix3d::Identity(), Matrix3d::Identity());
  map.move_to(shaken(mesh.nodes(), 0.012, 3), shaken(mesh.nodes(), 0.012, 4));
  ASSERT_TRUE(map.bijective());
  const Points points = some_points(500), images = map.forward(points);
  EXPECT_GT((images - points).rowwise().norm().maxCoeff(), 0.01);
  EXPECT_LT((map.backward(images) - points).rowwise().norm().maxCoeff(), 1e-12);
  EXPECT_EQ(map.forward(points, 3), images);
}

TEST(NodeMap, IsNoBijectionWithATriangleTurnedOver) {
  const NodeMesh mesh(3);
  NodeMap map = turned_map(mesh, Matrix3d::Identity(), Matrix3d::Identity());
  Points places = mesh.nodes();
  places.row(mesh.faces()(7, 0)) =
      mesh.nodes().row(mesh.faces()(7, 1)) + mesh.nodes().row(mesh.faces()(7, 2)) - mesh.nodes().row(mesh.faces()(7, 0));
  places.row(mesh.faces()(7, 0)).normalize();
  map.move_to(mesh.nodes(), places);
  EXPECT_FALSE(map.bijective());
  map.move_to(places, mesh.nodes());
  EXPECT_FALSE(map.bijective());
}

TEST(NodeMap, IsNoBijectionThatGoesRoundTwice) {
  // Without a triangle turned over: longitudes are doubled, with two branch points at the poles. Every triangle that is left is the right
  // way round, but each point has two.
  const NodeMesh mesh(4);
  NodeMap map = turned_map(mesh, Matrix3d::Identity(), Matrix3d::Identity());
  Points places = mesh.nodes();
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const double radius = std::hypot(places(i, 0), places(i, 1)), longitude = 2 * std::atan2(places(i, 1), places(i, 0));
    places.row(i) << radius * std::cos(longitude), radius * std::sin(longitude), places(i, 2);
  }
  map.move_to(mesh.nodes(), places);
  EXPECT_FALSE(map.bijective());
}

TEST(NodeMap, FollowsACoarserOne) {
  const NodeMesh coarse_mesh(3), fine_mesh(4);
  NodeMap coarse = turned_map(coarse_mesh, Matrix3d::Identity(), Matrix3d::Identity()),
          fine = turned_map(fine_mesh, Matrix3d::Identity(), Matrix3d::Identity());
  const Matrix3d turn = Eigen::AngleAxisd(0.1, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  coarse.move_to(coarse.source(), coarse.target() * turn.transpose());
  fine.follow(coarse);
  EXPECT_LT((fine.source() - fine_mesh.nodes()).rowwise().norm().maxCoeff(), 1e-3);
  // Moves along chords in between.
  EXPECT_LT((fine.target() - fine_mesh.nodes() * turn.transpose()).rowwise().norm().maxCoeff(), 1e-3);
  EXPECT_TRUE(fine.bijective());
}

}  // namespace
}  // namespace spherematch
