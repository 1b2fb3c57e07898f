#include "engine/register/elastic_flow.h"

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/register/strain.h"

namespace spherematch {
namespace {

/// Of the moves' squares, where nothing else holds a node.
constexpr double kInertia = 1e-3;

/// Of the squared distance of two points that belong together, against the mean of squared strains over the whole surface.
constexpr double kPairWeight = 10;

/// Of the equations' residual. At 0.05 what is smooth is left over, and flows take longer.
constexpr double kTolerance = 0.01;
constexpr int kMostIterations = 200;

/// A shape as the nodes see it: positions on the surface, then the compared signals.
struct NodeValues {
  NodeValues(const ElasticChannels& channels, const Points& origins, const NodeMesh& mesh)
      : values(origins.rows(), 3 + static_cast<Eigen::Index>(channels.compared.size())) {
    std::vector<Eigen::Index> read(channels.position.begin(), channels.position.end());
    read.insert(read.end(), channels.compared.begin(), channels.compared.end());
    channels.samples.for_each_stencil(origins, [&](Eigen::Index i, const GridSamples::Stencil& stencil) {
      Eigen::Index pack = -1;
      GridSamples::Pack four;
      for (std::size_t c = 0; c < read.size(); ++c) {
        if (read[c] / 4 != pack) four = channels.samples(stencil, static_cast<std::size_t>(pack = read[c] / 4));
        values(i, static_cast<Eigen::Index>(c)) = four[read[c] % 4];
      }
    });
    derivatives = mesh.derivatives(values);
  }

  [[nodiscard]] double derivative(Eigen::Index node, Eigen::Index channel, int direction) const {
    return derivatives(node, direction * values.cols() + channel);
  }

  [[nodiscard]] MovingTriangle triangle(const Triangles& faces, Eigen::Index face) const {
    MovingTriangle result;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t node = faces(face, k);
      const auto corner = static_cast<std::size_t>(k);
      result.corners[corner] = values.row(node).head<3>();
      for (int direction = 0; direction < 2; ++direction)
        result.velocities[corner].col(direction) = derivatives.row(node).segment<3>(direction * values.cols());
    }
    return result;
  }

  NodeMesh::Values values, derivatives;
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

  void add_strain(const NodeValues& source, const NodeValues& target) {
    const Eigen::Vector3d weights(parameters_.area, 1, 1);
    double* entries = matrix_.valuePtr();
    for (Eigen::Index f = 0; f < mesh_.faces().rows(); ++f) {
      const Strain s = strain(source.triangle(mesh_.faces(), f), target.triangle(mesh_.faces(), f));
      if (!(s.area > 0)) continue;
      const Eigen::Matrix<double, 6, 3> weighted = s.area * s.derivatives.transpose() * weights.asDiagonal();
      const Eigen::Matrix<double, 6, 1> gradient = weighted * s.values;
      const Eigen::Matrix<double, 6, 6> curvature = weighted * s.derivatives;
      energy_.strain += s.area * weights.dot(s.values.cwiseAbs2());
      area_ += s.area;
      for (int k = 0; k < 3; ++k) {
        const std::int32_t node = mesh_.faces()(f, k);
        right_.segment<2>(2 * node) -= gradient.segment<2>(2 * k);
        masses_[node] += s.area / 3;
      }
      add_lower_half(mesh_.face_slots(f), curvature, entries);
    }
  }

  /// After the strain, which says how much surface is round each node.
  void add_signals(const NodeValues& source, const NodeValues& target, const std::vector<double>& weights) {
    double* entries = matrix_.valuePtr();
    for (Eigen::Index i = 0; i < mesh_.count(); ++i) {
      const double inertia = kInertia * mesh_.area(i);
      double first = inertia, mixed = 0, second = inertia;
      for (std::size_t k = 0; k < weights.size(); ++k) {
        const auto channel = static_cast<Eigen::Index>(3 + k);
        const double weight = parameters_.signals * weights[k] * masses_[i],
                     difference = source.values(i, channel) - target.values(i, channel);
        const double a = -0.5 * (source.derivative(i, channel, 0) + target.derivative(i, channel, 0));
        const double b = -0.5 * (source.derivative(i, channel, 1) + target.derivative(i, channel, 1));
        first += weight * a * a;
        mixed += weight * a * b;
        second += weight * b * b;
        right_[2 * i] -= weight * difference * a;
        right_[2 * i + 1] -= weight * difference * b;
        energy_.signals += weights[k] * masses_[i] * difference * difference;
      }
      const NodeMesh::NodeSlots& slots = mesh_.node_slots(i);
      entries[slots[0]] += first;
      entries[slots[1]] += mixed;
      entries[slots[2]] += second;
    }
  }

  /// Points of the two sides, (H, 3), that belong together: at both the step is to be their distance.
  void add_pairs(const Points& source, const Points& target) {
    for (Eigen::Index i = 0; i < source.rows(); ++i) {
      const Eigen::Vector3d difference = source.row(i) - target.row(i);
      add_wish(source.row(i), -difference);
      add_wish(target.row(i), -difference);
    }
  }

  [[nodiscard]] const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }
  [[nodiscard]] const Eigen::VectorXd& right() const { return right_; }
  /// Before the step; to be asked for when everything is added.
  [[nodiscard]] ElasticEnergy energy() const {
    if (!(area_ > 0)) return {};
    return {energy_.strain / area_, energy_.signals / area_};
  }

 private:
  /// A step that one point is to make.
  void add_wish(const Eigen::Vector3d& point, const Eigen::Vector3d& wanted) {
    const Location at = mesh_.location().locate(point);
    Eigen::Matrix<double, 3, 6> step;
    for (int k = 0; k < 3; ++k) step.middleCols<2>(2 * k) = at.bary[k] * mesh_.tangents(mesh_.faces()(at.face, k));
    const Eigen::Matrix<double, 6, 1> right = kPairWeight * step.transpose() * wanted;
    for (int k = 0; k < 3; ++k) right_.segment<2>(2 * mesh_.faces()(at.face, k)) += right.segment<2>(2 * k);
    add_lower_half(mesh_.face_slots(at.face), kPairWeight * step.transpose() * step, matrix_.valuePtr());
  }

  static void add_lower_half(const NodeMesh::FaceSlots& slots, const Eigen::Matrix<double, 6, 6>& values, double* entries) {
    std::size_t next = 0;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j <= i; ++j) entries[slots[next++]] += values(i, j);
  }

  const NodeMesh& mesh_;
  const ElasticParameters& parameters_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::VectorXd right_;
  Eigen::VectorXd masses_;  ///< of the nodes: surface area round each
  ElasticEnergy energy_;
  double area_ = 0;
};

double longest(const Eigen::VectorXd& u) {
  double square = 0;
  for (Eigen::Index i = 0; i < u.size(); i += 2) square = std::max(square, u.segment<2>(i).squaredNorm());
  return std::sqrt(square);
}

}  // namespace

ElasticEnergy flow_elastically(FlowSide& source, const ElasticChannels& of_source, FlowSide& target, const ElasticChannels& of_target,
                               const HintDirections& hints, const NodeMesh& nodes, const ElasticParameters& parameters,
                               const Progress& progress) {
  source.follow(nodes.grid_resolution());
  target.follow(nodes.grid_resolution());
  // Preconditioned by the diagonal: some 60 cheap iterations take less time than an incomplete factor or a factorisation.
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower> solver;
  solver.setTolerance(kTolerance);
  solver.setMaxIterations(kMostIterations);
  ElasticEnergy energy;
  for (int iteration = 0; iteration < parameters.iterations; ++iteration) {
    progress.check();
    const NodeValues s(of_source, source.origins(nodes.nodes()), nodes), t(of_target, target.origins(nodes.nodes()), nodes);
    ElasticSystem system(nodes, parameters);
    system.add_strain(s, t);
    system.add_signals(s, t, of_source.weights);
    system.add_pairs(source.warp().forward(hints.source), target.warp().forward(hints.target));
    energy = system.energy();
    solver.compute(system.matrix());
    if (solver.info() != Eigen::Success) break;  // a surface without any extent at the nodes
    Eigen::VectorXd u = solver.solve(system.right());
    const double move = longest(u);
    if (!std::isfinite(move)) break;
    if (move > parameters.longest_move) u *= parameters.longest_move / move;
    const auto field = std::make_shared<const TangentField>(nodes.field(u));
    source.move(field, 0.5);
    target.move(field, -0.5);
    if (move < parameters.settled) break;
  }
  return energy;
}

}  // namespace spherematch
