#include "engine/sphere/flow_solver.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

namespace spherematch {
namespace {

/// Geometric mean over each face's corners.
Eigen::VectorXd face_means(const Eigen::VectorXd& values, const Triangles& faces) {
  Eigen::VectorXd means(faces.rows());
  for (Eigen::Index f = 0; f < faces.rows(); ++f) means[f] = std::cbrt(values[faces(f, 0)] * values[faces(f, 1)] * values[faces(f, 2)]);
  return means;
}

/// Root of the mean square of the distances between two states, `areas` (F) being the weights.
double distance(const Points& x, const Points& y, const Triangles& faces, const Eigen::VectorXd& areas) {
  const Eigen::VectorXd squares = (x - y).rowwise().squaredNorm();
  double sum = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) sum += areas[f] * (squares[faces(f, 0)] + squares[faces(f, 1)] + squares[faces(f, 2)]);
  return std::sqrt(sum / (3 * areas.sum()));
}

}  // namespace

void normalize(Points& x, const Triangles& faces) {
  double area = 0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Eigen::Vector3d a = x.row(faces(f, 0)), b = x.row(faces(f, 1)), c = x.row(faces(f, 2));
    const double w = 0.5 * (b - a).cross(c - a).norm();
    area += w;
    centroid += w / 3 * (a + b + c);
  }
  x.rowwise() -= (centroid / area).transpose();
  x /= std::sqrt(area);
}

FlowSolver::FlowSolver(Points& x, const Triangles& faces, const IntrinsicMesh& intrinsic)
    : x_(x),
      faces_(faces),
      intrinsic_(intrinsic),
      areas_(face_areas(intrinsic)),
      pattern_(edge_pattern({&faces, &intrinsic.faces}, x.rows())),
      flowing_(pattern_, faces),
      frozen_(pattern_, intrinsic.faces),
      stiffness_(pattern_),
      mass_(pattern_),
      system_(pattern_) {
  solver_.analyzePattern(pattern_);
}

void FlowSolver::set_stiffness(const Eigen::VectorXd& conductivity, double step_size) {
  const Eigen::VectorXd on_intrinsic = face_means(conductivity, intrinsic_.faces);
  frozen_.assemble(stiffness_, [&](Eigen::Index f) {
    ElementMatrix e = stiffness_element(intrinsic_.lengths.row(f), areas_[f]);
    for (double& entry : e) entry *= step_size * on_intrinsic[f];
    return e;
  });
  density_ = face_means(conductivity, faces_);
}

bool FlowSolver::step() {
  const Eigen::VectorXd current = face_areas(x_, faces_);
  flowing_.assemble(mass_, [&](Eigen::Index f) { return mass_element(density_[f] * current[f]); });
  for (Eigen::Index i = 0; i < system_.nonZeros(); ++i) system_.valuePtr()[i] = mass_.valuePtr()[i] + stiffness_.valuePtr()[i];
  solver_.factorize(system_);
  if (solver_.info() != Eigen::Success) return false;
  const Eigen::Matrix<double, Eigen::Dynamic, 3> right = mass_.selfadjointView<Eigen::Lower>() * x_;
  Points next = solver_.solve(right);
  if (!next.allFinite()) return false;
  normalize(next, faces_);
  last_move_ = distance(x_, next, faces_, current);
  x_ = std::move(next);
  return x_.allFinite();
}

}  // namespace spherematch
