#include "engine/sphere/mobius.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace spherematch {
namespace {

Eigen::Vector3d face_center(const Points& sphere, const Triangles& faces, Eigen::Index f) {
  return (sphere.row(faces(f, 0)) + sphere.row(faces(f, 1)) + sphere.row(faces(f, 2))).normalized();
}

struct Moments {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();      ///< centre of mass
  Eigen::Matrix3d derivative = Eigen::Matrix3d::Zero();  ///< of the centre by the boost
};

/// Of masses at unit vectors, `point(i)` for each i.
template <typename Point>
Moments measure(const Eigen::VectorXd& mass, const Point& point) {
  Moments moments;
  for (Eigen::Index i = 0; i < mass.size(); ++i) {
    const Eigen::Vector3d c = point(i);
    moments.center += mass[i] * c;
    moments.derivative += 2 * mass[i] * (Eigen::Matrix3d::Identity() - c * c.transpose());
  }
  return moments;
}

Moments measure(const Points& sphere, const Triangles& faces, const Eigen::VectorXd& face_mass) {
  return measure(face_mass, [&](Eigen::Index f) { return face_center(sphere, faces, f); });
}

/// The Newton step, shortened to stay inside the ball; zero at the solution.
Eigen::Vector3d newton_boost(const Moments& moments) {
  const Eigen::Vector3d s = -moments.derivative.ldlt().solve(moments.center);
  const double length = s.norm();
  return length > 1e-15 ? Eigen::Vector3d(std::tanh(std::min(length, 2.0)) / length * s) : Eigen::Vector3d::Zero();
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
  const Moments moments = measure(sphere, faces, face_mass);
  boost(sphere, newton_boost(moments));
  return moments.center.norm();
}

double centering_step(Points& sphere, const Eigen::VectorXd& vertex_mass) {
  const Moments moments = measure(vertex_mass, [&](Eigen::Index v) -> Eigen::Vector3d { return sphere.row(v); });
  boost(sphere, newton_boost(moments));
  return moments.center.norm();
}

double center(Points& sphere, const Triangles& faces, const Eigen::VectorXd& face_mass) {
  Moments moments = measure(sphere, faces, face_mass);
  for (int i = 0; i < 100 && moments.center.norm() > 1e-10; ++i) {
    // Far from the solution a whole step can overshoot; halved often enough it descends.
    double length = 1;
    for (; length > 1e-6; length /= 2) {
      Points trial = sphere;
      boost(trial, length * newton_boost(moments));
      const Moments after = measure(trial, faces, face_mass);
      if (after.center.norm() >= moments.center.norm()) continue;
      sphere = std::move(trial);
      moments = after;
      break;
    }
    if (length <= 1e-6) break;
  }
  return moments.center.norm();
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
