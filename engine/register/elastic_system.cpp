#include "engine/register/elastic_system.h"

#include <cmath>

#include "engine/register/for_runs.h"

namespace spherematch {
namespace {

/// Of the moves' squares, where nothing else holds a node.
constexpr double kInertia = 1e-3;

/// Of the squared distance of two points that belong together, against the mean of squared strains over the whole surface.
constexpr double kPairWeight = 10;
constexpr double kFarPair = 0.5;    ///< chord beyond which a pair draws less and less: it may be wrong
constexpr double kPairReach = 0.3;  ///< radians round a pair in which nodes are drawn along

/// Of the equations' residual. At 0.03 what is smooth is left over, and errors are larger by 2 percent.
constexpr double kTolerance = 0.005;
constexpr int kMostIterations = 200;

TriangleCorners corners(const PointValues& values, const Triangles& faces, Eigen::Index face) {
  TriangleCorners result;
  for (int k = 0; k < 3; ++k) result[static_cast<std::size_t>(k)] = values.row(faces(face, k)).head<3>().cast<double>();
  return result;
}

}  // namespace

MovingSide::MovingSide(const PointValues& at_nodes, const Points& places, const NodeMesh& mesh, int threads)
    : values(at_nodes), frames(static_cast<std::size_t>(places.rows())), derivatives(values.rows(), 2 * values.cols()) {
  for (Eigen::Index i = 0; i < places.rows(); ++i) frames[static_cast<std::size_t>(i)] = tangent_frame(places.row(i));
  for_runs(places.rows(), threads,
           [&](Eigen::Index first, Eigen::Index last) { mesh.differentiate(values, places, frames, first, last, derivatives); });
}

MovingTriangle MovingSide::triangle(const Triangles& faces, Eigen::Index face) const {
  MovingTriangle result;
  result.corners = corners(values, faces, face);
  for (int k = 0; k < 3; ++k)
    for (int direction = 0; direction < 2; ++direction)
      result.velocities[static_cast<std::size_t>(k)].col(direction) =
          derivatives.row(faces(face, k)).segment<3>(direction * values.cols()).cast<double>();
  return result;
}

ElasticSystem::ElasticSystem(const NodeMesh& mesh)
    : mesh_(mesh), matrix_(mesh.pattern()), right_(Eigen::VectorXd::Zero(2 * mesh.count())), masses_(Eigen::VectorXd::Zero(mesh.count())) {
  for (Eigen::Index i = 0; i < mesh.count(); ++i) matrix_.add(mesh.node_slot(i), kInertia * mesh.areas()[i] * Eigen::Matrix2d::Identity());
}

void ElasticSystem::add_strain(const PointValues& resting, const MovingSide& moving, double area, double yield, int threads) {
  struct Term {
    double area = 0, energy = 0;
    Eigen::Matrix<double, 6, 1> gradient;
    Eigen::Matrix<double, 6, 6> curvature;
  };
  const Eigen::Vector3d weights(area, 1, 1);
  std::vector<Term> terms(static_cast<std::size_t>(mesh_.faces().rows()));
  for_runs(mesh_.faces().rows(), threads, [&](Eigen::Index first, Eigen::Index last) {
    for (Eigen::Index f = first; f < last; ++f) {
      const auto face = static_cast<std::size_t>(f);
      const Strain s = spherematch::strain(FlatTriangle(corners(resting, mesh_.faces(), f)), moving.triangle(mesh_.faces(), f));
      if (!(s.area > 0)) continue;
      const double resistance = 1 / (1 + s.values.squaredNorm() / (yield * yield));
      const Eigen::Matrix<double, 6, 3> weighted = resistance * s.area * s.derivatives.transpose() * weights.asDiagonal();
      terms[face] = {s.area, s.area * weights.dot(s.values.cwiseAbs2()), weighted * s.values, weighted * s.derivatives};
    }
  });
  for (Eigen::Index f = 0; f < mesh_.faces().rows(); ++f) {
    const Term& term = terms[static_cast<std::size_t>(f)];
    if (!(term.area > 0)) continue;
    strain_ += term.energy;
    area_ += term.area;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Index node = mesh_.faces()(f, k);
      right_.segment<2>(2 * node) -= term.gradient.segment<2>(2 * k);
      masses_[node] += term.area / 3;
    }
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index j = 0; j < 3; ++j)
        matrix_.add(mesh_.face_slots(f)[static_cast<std::size_t>(3 * i + j)], term.curvature.block<2, 2>(2 * i, 2 * j));
  }
}

void ElasticSystem::add_differences(const MovingSide& moving, Eigen::Index first, const PointValues& differences,
                                    const Eigen::RowVectorXf& weights, double yield, int threads) {
  const Eigen::VectorXd squares = (differences.cwiseAbs2() * weights.transpose()).cast<double>();
  const double mean = squares.dot(masses_) / masses_.sum();
  if (!(mean > 0)) return;
  const Eigen::Index second = moving.values.cols();  // from a derivative along one direction to that along the other
  for_runs(mesh_.count(), threads, [&](Eigen::Index first_node, Eigen::Index last_node) {
    for (Eigen::Index i = first_node; i < last_node; ++i) {
      const double trust = masses_[i] * (1 + yield) / (yield + squares[i] / mean);
      const auto along = moving.derivatives.row(i).segment(first, weights.size()),
                 across = moving.derivatives.row(i).segment(second + first, weights.size());
      const Eigen::RowVectorXf weighted_along = weights.cwiseProduct(along), weighted_across = weights.cwiseProduct(across);
      Eigen::Matrix2d block;
      block << weighted_along.dot(along), weighted_along.dot(across), weighted_along.dot(across), weighted_across.dot(across);
      matrix_.add(mesh_.node_slot(i), trust * block);
      const auto difference = differences.row(i);
      right_.segment<2>(2 * i) -= trust * Eigen::Vector2d(weighted_along.dot(difference), weighted_across.dot(difference));
    }
  });
}

void ElasticSystem::add_wish(const Points& places, const Eigen::Vector3d& point, const Eigen::Vector3d& wanted,
                             const std::vector<TangentFrame>& frames) {
  const Eigen::VectorXd near = (1 - (places * point).array()).cwiseMax(0);  // half of the square of the distance
  const Eigen::VectorXd shares = (1 - 2 * near.array() / (kPairReach * kPairReach)).cwiseMax(0).square();
  const double sum = shares.sum() * (1 + std::pow(wanted.norm() / kFarPair, 4));
  if (!(sum > 0)) return;
  for (Eigen::Index i = 0; i < shares.size(); ++i) {
    if (shares[i] == 0) continue;
    const double weight = kPairWeight * shares[i] / sum;
    right_.segment<2>(2 * i) += weight * frames[static_cast<std::size_t>(i)].transpose() * wanted;
    matrix_.add(mesh_.node_slot(i), weight * Eigen::Matrix2d::Identity());
  }
}

Eigen::VectorXd ElasticSystem::solve() const { return matrix_.solve(right_, kTolerance, kMostIterations); }

}  // namespace spherematch
