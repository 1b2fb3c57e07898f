#include "engine/sphere/mobius.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace spherematch {
namespace {

Eigen::Vector3d face_center(const Points& sphere, const Triangles& faces, Eigen::Index f) {
  return (sphere.row(faces(f, 0)) + sphere.row(faces(f, 1)) + sphere.row(faces(f, 2))).normalized();
}

}  // namespace

void boost(Points& sphere, const Eigen::Vector3d& c) {
  const double scale = 1 - c.squaredNorm();
  for (Eigen::Index i = 0; i < sphere.rows(); ++i) {
    const Eigen::Vector3d q = sphere.row(i).transpose() + c;
    sphere.row(i) = (scale / q.squaredNorm() * q + c).normalized();
  }
}

double centering_step(Points& sphere, const Triangles& faces, const Eigen::VectorXd& face_mass) {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d derivative = Eigen::Matrix3d::Zero();
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Eigen::Vector3d c = face_center(sphere, faces, f);
    center += face_mass[f] * c;
    derivative += 2 * face_mass[f] * (Eigen::Matrix3d::Identity() - c * c.transpose());
  }
  const Eigen::Vector3d s = -derivative.ldlt().solve(center);
  const double length = s.norm();
  if (length > 1e-15) boost(sphere, std::tanh(std::min(length, 2.0)) / length * s);
  return center.norm();
}

double center(Points& sphere, const Triangles& faces, const Eigen::VectorXd& face_mass) {
  double distance = 1;
  for (int i = 0; i < 100 && distance > 1e-10; ++i) distance = centering_step(sphere, faces, face_mass);
  return distance;
}

void rotate_to_principal_axes(Points& sphere, const Triangles& faces, const Eigen::VectorXd& face_mass) {
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Eigen::Vector3d c = face_center(sphere, faces, f);
    second += face_mass[f] * c * c.transpose();
  }
  Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(second).eigenvectors();
  Eigen::Vector3d third = Eigen::Vector3d::Zero();
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    third += face_mass[f] * (axes.transpose() * face_center(sphere, faces, f)).array().cube().matrix();
  // A shape with a mirror symmetry has no third moment across it: handedness decides that axis.
  Eigen::Index weakest = 0;
  third.cwiseAbs().minCoeff(&weakest);
  for (Eigen::Index k = 0; k < 3; ++k)
    if (k != weakest && third[k] < 0) axes.col(k) = -axes.col(k);
  if (axes.determinant() < 0) axes.col(weakest) = -axes.col(weakest);
  sphere = (sphere * axes).eval();
  sphere.rowwise().normalize();
}

}  // namespace spherematch
