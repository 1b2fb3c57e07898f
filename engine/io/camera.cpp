#include "engine/io/camera.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <numbers>

namespace spherematch {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double three_quarter_view = 25 * degree;

struct Moments {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Of the surface as a thin shell.
Moments moments_of(const TriMesh& mesh) {
  Moments moments;
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  double total = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const Eigen::Vector3d a = mesh.vertices.row(mesh.faces(f, 0));
    const Eigen::Vector3d b = mesh.vertices.row(mesh.faces(f, 1));
    const Eigen::Vector3d c = mesh.vertices.row(mesh.faces(f, 2));
    const double area = (b - a).cross(c - a).norm() / 2;
    const Eigen::Vector3d sum = a + b + c;
    moments.center += area / 3 * sum;
    second += area / 12 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    total += area;
  }
  moments.center /= total;
  moments.covariance = second / total - moments.center * moments.center.transpose();
  return moments;
}

/// How a body rests if the given axis is up.
struct Footing {
  bool stands = false;       ///< the center lies above the box of the lowest points: on its feet, not on its nose
  double center_height = 0;  ///< of the center, as a share of the body's height
};

Footing footing_on(const TriMesh& mesh, const Eigen::Vector3d& center, int up) {
  constexpr double lowest_part = 0.06;
  const double low = mesh.vertices.col(up).minCoeff();
  const double height = mesh.vertices.col(up).maxCoeff() - low;
  Eigen::Vector3d box_low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d box_high = -box_low;
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.vertices(v, up) > low + lowest_part * height) continue;
    box_low = box_low.cwiseMin(mesh.vertices.row(v).transpose());
    box_high = box_high.cwiseMax(mesh.vertices.row(v).transpose());
  }
  bool stands = true;
  for (const int side : {(up + 1) % 3, (up + 2) % 3}) stands = stands && box_low(side) < center(side) && center(side) < box_high(side);
  return {stands, (center(up) - low) / height};
}

int upward_axis(const TriMesh& mesh, const Moments& moments, const Eigen::Vector3d& least, const Eigen::Vector3d& longest) {
  constexpr int x = 0, y = 1, z = 2;
  int along_front = x;
  least.cwiseAbs().maxCoeff(&along_front);
  if (along_front == z) return y;
  if (along_front == y) return z;
  const Footing on_y = footing_on(mesh, moments.center, y);
  const Footing on_z = footing_on(mesh, moments.center, z);
  if (on_y.stands != on_z.stands) return on_y.stands ? y : z;
  // Legs are thin and bodies are high above them; who leaps is long rather than broad.
  const bool y_is_up = on_y.stands ? on_y.center_height >= on_z.center_height : std::abs(longest(y)) >= std::abs(longest(z));
  return y_is_up ? y : z;
}

/// The level direction nearest to `direction`, which is not up or down.
Eigen::Vector3d leveled(const Eigen::Vector3d& direction, const Eigen::Vector3d& up) {
  return (direction - direction.dot(up) * up).normalized();
}

}  // namespace

Pose upright_pose(const TriMesh& mesh) {
  const Moments moments = moments_of(mesh);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments.covariance);
  const int axis = upward_axis(mesh, moments, solver.eigenvectors().col(0), solver.eigenvectors().col(2));
  const Eigen::Vector3d up = Eigen::Vector3d::Unit(axis);
  // Models usually face z where y is up, and -y where z is up. Of the two broad sides, seen from that one; where both are flanks, from
  // x. Then a little round toward the face, since pure profiles and fronts look flat.
  const Eigen::Vector3d face = axis == 1 ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(0, -1, 0);
  Eigen::Vector3d side = leveled(solver.eigenvectors().col(0), up);
  if (side.dot(face + 0.1 * Eigen::Vector3d::UnitX()) < 0) side = -side;
  const double turn = up.cross(side).dot(face) < -0.5 ? -three_quarter_view : three_quarter_view;
  return {up, Eigen::AngleAxisd(turn, up) * side};
}

Pose corresponding_pose(const Pose& pose, const Eigen::Matrix3d& rotation) {
  Pose turned{rotation.transpose() * pose.up, rotation.transpose() * pose.front};
  int axis = 0;
  const double share = turned.up.cwiseAbs().maxCoeff(&axis);
  if (share > std::cos(40 * degree)) turned.up = std::copysign(1.0, turned.up(axis)) * Eigen::Vector3d::Unit(axis);
  return turned;
}

Eigen::Matrix3d best_rotation(const Points& from, const Points& to, const Eigen::VectorXd& weights) {
  const auto counts = [&](Eigen::Index i) { return weights(i) > 0 && from.row(i).allFinite() && to.row(i).allFinite(); };
  Eigen::RowVector3d from_mean = Eigen::RowVector3d::Zero();
  Eigen::RowVector3d to_mean = Eigen::RowVector3d::Zero();
  double total = 0;
  for (Eigen::Index i = 0; i < from.rows(); ++i) {
    if (!counts(i)) continue;
    from_mean += weights(i) * from.row(i);
    to_mean += weights(i) * to.row(i);
    total += weights(i);
  }
  if (total <= 0) return Eigen::Matrix3d::Identity();
  from_mean /= total;
  to_mean /= total;
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < from.rows(); ++i)
    if (counts(i)) correlation += weights(i) * (to.row(i) - to_mean).transpose() * (from.row(i) - from_mean);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(correlation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.singularValues()(1) <= 1e-9 * svd.singularValues()(0)) return Eigen::Matrix3d::Identity();
  Eigen::Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

ViewAxes view_axes(const Pose& pose) {
  constexpr double elevation = 10 * degree;
  const Eigen::Vector3d level = leveled(pose.front, pose.up);
  const Eigen::Vector3d right = pose.up.cross(level).normalized();
  const Eigen::Vector3d toward = Eigen::AngleAxisd(-elevation, right) * level;
  ViewAxes axes;
  axes.row(0) = right;
  axes.row(1) = toward.cross(right);
  axes.row(2) = toward;
  return axes;
}

}  // namespace spherematch
