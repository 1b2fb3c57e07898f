#include "engine/register/elastic_flow.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/data/parallel.h"
#include "engine/register/composition.h"
#include "engine/register/point_location.h"
#include "engine/register/strain.h"
#include "engine/sphere/orientation.h"

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

/// Calls task(first, last) for runs of 0 .. count - 1 that do not depend on the number of threads.
template <typename Task>
void for_runs(Eigen::Index count, int threads, const Task& task) {
  constexpr Eigen::Index kRun = 1024;
  run_parallel(static_cast<std::size_t>((count + kRun - 1) / kRun), threads, [&](std::size_t run) {
    const Eigen::Index first = static_cast<Eigen::Index>(run) * kRun;
    task(first, std::min(count, first + kRun));
  });
}

/// A shape at points of its sphere: positions on the surface, then the compared signals.
PointValues sample(const ElasticChannels& channels, const Points& places, int threads) {
  std::vector<Eigen::Index> read(channels.position.begin(), channels.position.end());
  read.insert(read.end(), channels.compared.begin(), channels.compared.end());
  PointValues values(places.rows(), static_cast<Eigen::Index>(read.size()));
  for_runs(places.rows(), threads, [&](Eigen::Index first, Eigen::Index last) {
    channels.samples.for_each_stencil(places.middleRows(first, last - first), [&](Eigen::Index i, const GridSamples::Stencil& stencil) {
      Eigen::Index pack = -1;
      GridSamples::Pack four;
      for (std::size_t c = 0; c < read.size(); ++c) {
        if (read[c] / 4 != pack) four = channels.samples(stencil, static_cast<std::size_t>(pack = read[c] / 4));
        values(first + i, static_cast<Eigen::Index>(c)) = four[read[c] % 4];
      }
    });
  });
  return values;
}

TriangleCorners corners(const PointValues& values, const Triangles& faces, Eigen::Index face) {
  TriangleCorners result;
  for (int k = 0; k < 3; ++k) result[static_cast<std::size_t>(k)] = values.row(faces(face, k)).head<3>();
  return result;
}

/// The shape whose nodes move in a step: its values there, and how these change.
struct MovingSide {
  MovingSide(const PointValues& at_nodes, const Points& places, const NodeMesh& mesh, int threads)
      : values(at_nodes), frames(static_cast<std::size_t>(places.rows())), derivatives(values.rows(), 2 * values.cols()) {
    for (Eigen::Index i = 0; i < places.rows(); ++i) frames[static_cast<std::size_t>(i)] = tangent_frame(places.row(i));
    for_runs(places.rows(), threads,
             [&](Eigen::Index first, Eigen::Index last) { mesh.differentiate(values, places, frames, first, last, derivatives); });
  }

  [[nodiscard]] double derivative(Eigen::Index node, Eigen::Index channel, int direction) const {
    return derivatives(node, direction * values.cols() + channel);
  }

  [[nodiscard]] MovingTriangle triangle(const Triangles& faces, Eigen::Index face) const {
    MovingTriangle result;
    result.corners = corners(values, faces, face);
    for (int k = 0; k < 3; ++k)
      for (int direction = 0; direction < 2; ++direction)
        result.velocities[static_cast<std::size_t>(k)].col(direction) =
            derivatives.row(faces(face, k)).segment<3>(direction * values.cols());
    return result;
  }

  const PointValues& values;
  std::vector<TangentFrame> frames;
  PointValues derivatives;
};

/// The quadratic model of one step.
class ElasticSystem {
 public:
  ElasticSystem(const NodeMesh& mesh, const ElasticParameters& parameters)
      : mesh_(mesh),
        parameters_(parameters),
        matrix_(mesh.pattern()),
        right_(Eigen::VectorXd::Zero(2 * mesh.count())),
        masses_(Eigen::VectorXd::Zero(mesh.count())) {}

  /// Of the map from the resting shape, whose values at the nodes are given, to the other.
  void add_strain(const PointValues& resting, const MovingSide& moving, int threads) {
    struct Term {
      double area = 0, energy = 0;
      Eigen::Matrix<double, 6, 1> gradient;
      Eigen::Matrix<double, 6, 6> curvature;
    };
    const Eigen::Vector3d weights(parameters_.area, 1, 1);
    std::vector<Term> terms(static_cast<std::size_t>(mesh_.faces().rows()));
    for_runs(mesh_.faces().rows(), threads, [&](Eigen::Index first, Eigen::Index last) {
      for (Eigen::Index f = first; f < last; ++f) {
        const auto face = static_cast<std::size_t>(f);
        const Strain s = strain(FlatTriangle(corners(resting, mesh_.faces(), f)), moving.triangle(mesh_.faces(), f));
        if (!(s.area > 0)) continue;
        const double resistance = 1 / (1 + s.values.squaredNorm() / (parameters_.yield * parameters_.yield));
        const Eigen::Matrix<double, 6, 3> weighted = resistance * s.area * s.derivatives.transpose() * weights.asDiagonal();
        terms[face] = {s.area, s.area * weights.dot(s.values.cwiseAbs2()), weighted * s.values, weighted * s.derivatives};
      }
    });
    for (Eigen::Index f = 0; f < mesh_.faces().rows(); ++f) {
      const Term& term = terms[static_cast<std::size_t>(f)];
      if (!(term.area > 0)) continue;
      energy_.strain += term.energy;
      area_ += term.area;
      for (int k = 0; k < 3; ++k) {
        const std::int32_t node = mesh_.faces()(f, k);
        right_.segment<2>(2 * node) -= term.gradient.segment<2>(2 * k);
        masses_[node] += term.area / 3;
      }
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          matrix_.add(mesh_.face_slots(f)[static_cast<std::size_t>(3 * i + j)], term.curvature.block<2, 2>(2 * i, 2 * j));
    }
  }

  /// After the strain, which says how much surface is round each node.
  void add_signals(const PointValues& resting, const MovingSide& moving, const std::vector<double>& weights) {
    for (Eigen::Index i = 0; i < mesh_.count(); ++i) {
      const double inertia = kInertia * mesh_.areas()[i];
      double first = inertia, mixed = 0, second = inertia;
      for (std::size_t k = 0; k < weights.size(); ++k) {
        const auto channel = static_cast<Eigen::Index>(3 + k);
        const double weight = parameters_.signals * weights[k] * masses_[i], difference = moving.values(i, channel) - resting(i, channel);
        const double a = moving.derivative(i, channel, 0), b = moving.derivative(i, channel, 1);
        first += weight * a * a;
        mixed += weight * a * b;
        second += weight * b * b;
        right_[2 * i] -= weight * difference * a;
        right_[2 * i + 1] -= weight * difference * b;
        energy_.signals += weights[k] * masses_[i] * difference * difference;
      }
      Eigen::Matrix2d block;
      block << first, mixed, mixed, second;
      matrix_.add(mesh_.node_slot(i), block);
    }
  }

  /// A step that the nodes at `places` round a point are to make: many of them, for one alone would turn triangles over.
  void add_wish(const Points& places, const Eigen::Vector3d& point, const Eigen::Vector3d& wanted,
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

  /// The step, two components per node.
  [[nodiscard]] Eigen::VectorXd solve() const { return matrix_.solve(right_, kTolerance, kMostIterations); }
  /// Before the step; to be asked for when everything is added.
  [[nodiscard]] ElasticEnergy energy() const {
    if (!(area_ > 0)) return {};
    return {energy_.strain / area_, energy_.signals / area_};
  }

 private:
  const NodeMesh& mesh_;
  const ElasticParameters& parameters_;
  BlockMatrix matrix_;
  Eigen::VectorXd right_;
  Eigen::VectorXd masses_;  ///< of the nodes: surface area round each
  ElasticEnergy energy_;
  double area_ = 0;
};

/// Draws the moving points of pairs that belong together towards the images of the resting ones.
void add_pairs(ElasticSystem& system, const Triangles& faces, const Points& resting_places, const Points& resting_points,
               const Points& moving_places, const Points& moving_points, const std::vector<TangentFrame>& frames) {
  if (resting_points.rows() == 0) return;
  const std::vector<Location> at = locate_all(resting_points, PointLocation(resting_places, faces));
  for (std::size_t i = 0; i < at.size(); ++i) {
    Eigen::Vector3d image = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) image += at[i].bary[k] * moving_places.row(faces(at[i].face, k)).transpose();
    const auto pair = static_cast<Eigen::Index>(i);
    system.add_wish(resting_places, resting_points.row(pair), moving_points.row(pair).transpose() - image.normalized(), frames);
  }
}

/// Places of nodes after the step u, in which none moves farther than allowed. Steps are shortened where triangles would be turned over.
Points stepped(const Points& places, const Eigen::VectorXd& u, const std::vector<TangentFrame>& frames, double longest_move,
               const NodeMesh& mesh) {
  constexpr int kHalvings = 6;
  const Triangles& faces = mesh.faces();
  std::vector<Eigen::Vector3d> moves;
  for (Eigen::Index i = 0; i < mesh.count(); ++i) {
    const double length = u.segment<2>(2 * i).norm();
    moves.push_back(frames[static_cast<std::size_t>(i)] * u.segment<2>(2 * i) * (length > longest_move ? longest_move / length : 1));
  }
  Points result(places.rows(), 3);
  std::vector<std::int32_t> flipped;
  for (int halving = 0; halving <= kHalvings; ++halving) {
    for (Eigen::Index i = 0; i < places.rows(); ++i)
      result.row(i) = (places.row(i).transpose() + moves[static_cast<std::size_t>(i)]).normalized();
    flipped = flipped_faces(result, faces);
    if (flipped.empty()) return result;
    std::vector<char> shortened(moves.size(), 0);
    for (const std::int32_t f : flipped)
      for (int k = 0; k < 3; ++k) {
        const auto node = static_cast<std::size_t>(faces(f, k));
        if (!shortened[node]) moves[node] /= 2;
        shortened[node] = 1;
      }
  }
  // Where shorter steps did not help, the triangles are mended; a step that leaves more turned over than there were is not taken.
  if (mesh.repair().repair(result) || flipped_faces(result, faces).size() <= flipped_faces(places, faces).size()) return result;
  return places;
}

double longest(const Eigen::VectorXd& u) {
  double square = 0;
  for (Eigen::Index i = 0; i < u.size(); i += 2) square = std::max(square, u.segment<2>(i).squaredNorm());
  return std::sqrt(square);
}

}  // namespace

ElasticEnergy flow_elastically(NodeMap& map, const ElasticChannels& source, const ElasticChannels& target, const HintDirections& hints,
                               const ElasticParameters& parameters, const Progress& progress, int threads) {
  struct Side {
    const ElasticChannels& channels;
    const Points& hints;
    Points places;
    PointValues values;
  };
  const NodeMesh& mesh = map.mesh();
  Side sides[2] = {{target, hints.target, map.target(), sample(target, map.target(), threads)},
                   {source, hints.source, map.source(), sample(source, map.source(), threads)}};
  ElasticEnergy energy;
  for (int iteration = 0; iteration < parameters.iterations; ++iteration) {
    progress.check();
    Side &moving = sides[iteration % 2], &resting = sides[(iteration + 1) % 2];
    const MovingSide t(moving.values, moving.places, mesh, threads);
    ElasticSystem system(mesh, parameters);
    system.add_strain(resting.values, t, threads);
    system.add_signals(resting.values, t, source.weights);
    add_pairs(system, mesh.faces(), resting.places, resting.hints, moving.places, moving.hints, t.frames);
    energy = system.energy();
    const Eigen::VectorXd u = system.solve();
    const double move = longest(u);
    if (!std::isfinite(move)) break;
    moving.places = stepped(moving.places, u, t.frames, parameters.longest_move, mesh);
    if (move < parameters.settled) break;
    moving.values = sample(moving.channels, moving.places, threads);
  }
  map.move_to(std::move(sides[1].places), std::move(sides[0].places));
  return energy;
}

}  // namespace spherematch
