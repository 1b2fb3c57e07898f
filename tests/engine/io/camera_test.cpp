#include "engine/io/camera.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/support/meshes.h"

namespace spherematch::test {
namespace {

const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();

/// Takes y up and z ahead to z up and -y ahead.
const Eigen::Matrix3d to_z_up = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();

TriMesh turned(const TriMesh& mesh, const Eigen::Matrix3d& rotation) { return transformed(mesh, 1, rotation, Eigen::Vector3d::Zero()); }

TriMesh limb(const Eigen::Vector3d& half_axes, const Eigen::Vector3d& center) {
  return transformed(ellipsoid(2, half_axes), 1, Eigen::Matrix3d::Identity(), center);
}

/// Four legs of length 1, trunk and tail along z, y up; longer than high and broad.
TriMesh quadruped() {
  TriMesh body = limb({0.3, 0.4, 1}, {0, 1.3, 0});
  body = joined(body, limb({0.1, 0.1, 0.8}, {0, 1.5, -1.6}));
  for (const double side : {-0.15, 0.15})
    for (const double along : {-0.7, 0.7}) body = joined(body, limb({0.1, 0.6, 0.1}, {side, 0.6, along}));
  return body;
}

TEST(Camera, ABroadBodyIsSeenFromTheFront) {
  const Pose standing = upright_pose(ellipsoid(3, {1, 3, 0.5}));
  EXPECT_EQ(standing.up, y);
  EXPECT_NEAR(standing.front.dot(z), std::cos(25 * M_PI / 180), 1e-9);
  const Pose z_up = upright_pose(turned(ellipsoid(3, {1, 3, 0.5}), to_z_up));
  EXPECT_EQ(z_up.up, z);
  EXPECT_NEAR(z_up.front.dot(-y), std::cos(25 * M_PI / 180), 1e-9);
}

TEST(Camera, AQuadrupedIsSeenFromItsFlankAndALittleFromAhead) {
  const Pose pose = upright_pose(quadruped());
  EXPECT_EQ(pose.up, y);
  EXPECT_NEAR(pose.front.dot(x), std::cos(25 * M_PI / 180), 1e-3);
  EXPECT_GT(pose.front.dot(z), 0.4);
  const Pose z_up = upright_pose(turned(quadruped(), to_z_up));
  EXPECT_EQ(z_up.up, z);
  EXPECT_GT(z_up.front.dot(-y), 0.4);
}

TEST(Camera, BestRotationFindsATurnUnderWeights) {
  const Points from = creature(3).vertices;
  Points to = transformed(creature(3), 2, some_rotation(), {1, 2, 3}).vertices;
  Eigen::VectorXd weights = Eigen::VectorXd::LinSpaced(from.rows(), 1, 2);
  to.row(5).setConstant(std::numeric_limits<double>::quiet_NaN());
  to.row(6).setConstant(1000);
  weights(6) = 0;
  EXPECT_LT((best_rotation(from, to, weights) - some_rotation()).norm(), 1e-9);
}

TEST(Camera, BestRotationNeverMirrors) {
  const Points from = creature(3).vertices;
  const Points mirrored = from * Eigen::Vector3d(-1, 1, 1).asDiagonal();
  const Eigen::Matrix3d rotation = best_rotation(from, mirrored, Eigen::VectorXd::Ones(from.rows()));
  EXPECT_NEAR(rotation.determinant(), 1, 1e-12);
}

TEST(Camera, BestRotationOfTooLittleIsTheIdentity) {
  const Points none = Points::Constant(4, 3, std::numeric_limits<double>::quiet_NaN());
  const Points line = Eigen::VectorXd::LinSpaced(4, 0, 1) * Eigen::RowVector3d(1, 2, 3);
  EXPECT_EQ(best_rotation(none, line, Eigen::VectorXd::Ones(4)), Eigen::Matrix3d::Identity());
  EXPECT_EQ(best_rotation(line, line, Eigen::VectorXd::Ones(4)), Eigen::Matrix3d::Identity());
}

TEST(Camera, TheCorrespondingPoseFollowsAndStandsUpright) {
  const Pose pose{y, z};
  // A target with z up whose points come to lie on the source's, but for a tilt of 20 degrees.
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(20 * M_PI / 180, z).toRotationMatrix();
  const Pose follower = corresponding_pose(pose, (to_z_up * tilt).transpose());
  EXPECT_EQ(follower.up, z);
  EXPECT_LT((follower.front - to_z_up * z).norm(), 1e-12);
  // Too far from each of its axes: the turn is taken as it is.
  const Eigen::Matrix3d oblique = Eigen::AngleAxisd(45 * M_PI / 180, z).toRotationMatrix();
  EXPECT_LT((corresponding_pose(pose, oblique.transpose()).up - oblique * y).norm(), 1e-12);
}

TEST(Camera, AxesAreARotationWithUpVertical) {
  for (const Pose& pose : {Pose{y, z}, Pose{z, -y}, Pose{y, (z + 0.5 * y).normalized()}, Pose{y, (z - 0.9 * y).normalized()}}) {
    const ViewAxes axes = view_axes(pose);
    EXPECT_LT((axes * axes.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(axes.determinant(), 1, 1e-12);
    EXPECT_NEAR(axes.row(0).dot(pose.up), 0, 1e-12);
    EXPECT_GT(axes.row(1).dot(pose.up), 0);
  }
  // Ten degrees from above, wherever the front points.
  EXPECT_NEAR(view_axes({y, (z + 0.5 * y).normalized()}).row(2).dot(y), std::sin(10 * M_PI / 180), 1e-12);
}

}  // namespace
}  // namespace spherematch::test
