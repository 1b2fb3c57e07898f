#include "engine/register/node_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/sphere/grid.h"
#include "engine/sphere/icosphere.h"

namespace spherematch {
namespace {

Eigen::Matrix<double, 3, 2> tangents_at(const Eigen::Vector3d& p) {
  const Eigen::Vector3d across = std::abs(p.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d first = across.cross(p).normalized();
  Eigen::Matrix<double, 3, 2> result;
  result << first, p.cross(first);
  return result;
}

/// Towards growing colatitude and growing longitude.
Eigen::Matrix<double, 3, 2> grid_directions(const Eigen::Vector3d& p) {
  const double radius = std::hypot(p.x(), p.y()), c = p.x() / radius, s = p.y() / radius;
  Eigen::Matrix<double, 3, 2> result;
  result << p.z() * c, -s, p.z() * s, c, -radius, 0;
  return result;
}

}  // namespace

NodeMesh::NodeMesh(int subdivisions, int grid_resolution)
    : mesh_(icosphere(subdivisions)),
      location_(mesh_.vertices, mesh_.faces),
      grid_resolution_(grid_resolution),
      areas_(Eigen::VectorXd::Zero(mesh_.vertex_count())) {
  for (Eigen::Index i = 0; i < count(); ++i) tangents_.push_back(tangents_at(nodes().row(i)));
  for (Eigen::Index f = 0; f < faces().rows(); ++f) {
    Eigen::Vector3d p[3];
    for (int k = 0; k < 3; ++k) p[k] = nodes().row(faces()(f, k));
    const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    Eigen::Matrix3d gradient;
    for (int k = 0; k < 3; ++k) gradient.col(k) = normal.normalized().cross(p[(k + 2) % 3] - p[(k + 1) % 3]) / 2;
    gradients_.push_back(gradient);
    for (int k = 0; k < 3; ++k) areas_[faces()(f, k)] += normal.norm() / 6;
  }

  const Points centers = cell_centers(grid_resolution);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < centers.rows(); ++i) {
    const Location at = location_.locate(centers.row(i));
    const Eigen::Matrix<double, 3, 2> directions = grid_directions(centers.row(i));
    for (int k = 0; k < 3; ++k) {
      const std::int32_t node = faces()(at.face, k);
      const Eigen::Matrix2d share = at.bary[k] * directions.transpose() * tangents_[static_cast<std::size_t>(node)];
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) entries.emplace_back(static_cast<int>(a * centers.rows() + i), 2 * node + b, share(a, b));
    }
  }
  grid_field_.resize(2 * centers.rows(), 2 * count());
  grid_field_.setFromTriplets(entries.begin(), entries.end());
  make_pattern();
}

void NodeMesh::make_pattern() {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index f = 0; f < faces().rows(); ++f)
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        const int row = 2 * faces()(f, i / 2) + i % 2, column = 2 * faces()(f, j / 2) + j % 2;
        if (row >= column) entries.emplace_back(row, column, 0.0);
      }
  pattern_.resize(2 * count(), 2 * count());
  pattern_.setFromTriplets(entries.begin(), entries.end());
  const auto slot = [this](int row, int column) {
    const int low = std::max(row, column), left = std::min(row, column);
    const int* first = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[left];
    const int* last = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[left + 1];
    return static_cast<std::int32_t>(std::lower_bound(first, last, low) - pattern_.innerIndexPtr());
  };
  for (Eigen::Index f = 0; f < faces().rows(); ++f) {
    FaceSlots slots;
    std::size_t next = 0;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j <= i; ++j) slots[next++] = slot(2 * faces()(f, i / 2) + i % 2, 2 * faces()(f, j / 2) + j % 2);
    face_slots_.push_back(slots);
  }
  for (int i = 0; i < static_cast<int>(count()); ++i)
    node_slots_.push_back({slot(2 * i, 2 * i), slot(2 * i + 1, 2 * i), slot(2 * i + 1, 2 * i + 1)});
}

NodeMesh::Values NodeMesh::derivatives(const Values& values) const {
  const Eigen::Index c = values.cols();
  Values sums = Values::Zero(count(), 3 * c), result(count(), 2 * c);
  Eigen::RowVectorXd gradient(3 * c);
  for (Eigen::Index f = 0; f < faces().rows(); ++f) {
    gradient.setZero();
    for (int k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis)
        gradient.segment(axis * c, c) += gradients_[static_cast<std::size_t>(f)](axis, k) * values.row(faces()(f, k));
    for (int k = 0; k < 3; ++k) sums.row(faces()(f, k)) += gradient;
  }
  for (Eigen::Index i = 0; i < count(); ++i) {
    const Eigen::Matrix<double, 3, 2>& tangents = tangents_[static_cast<std::size_t>(i)];
    for (int direction = 0; direction < 2; ++direction) {
      auto derivative = result.row(i).segment(direction * c, c);
      derivative.setZero();
      for (int axis = 0; axis < 3; ++axis) derivative += tangents(axis, direction) / (3 * areas_[i]) * sums.row(i).segment(axis * c, c);
    }
  }
  return result;
}

TangentGrid NodeMesh::field(const Eigen::VectorXd& u) const {
  const Eigen::Index n = grid_resolution_;
  const Eigen::VectorXd components = grid_field_ * u;
  return {Eigen::Map<const Grid>(components.data(), n, n), Eigen::Map<const Grid>(components.data() + n * n, n, n)};
}

}  // namespace spherematch
