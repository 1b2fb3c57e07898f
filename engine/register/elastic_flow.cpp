#include "engine/register/elastic_flow.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/register/composition.h"
#include "engine/register/for_runs.h"
#include "engine/register/functional_map.h"
#include "engine/register/point_location.h"
#include "engine/sphere/orientation.h"

namespace spherematch {
namespace {

/// A shape at points of its sphere: positions on the surface, then the compared signals, then so many eigenfunctions.
PointValues sample(const ElasticChannels& channels, int eigenfunctions, const Points& places, int threads) {
  std::vector<Eigen::Index> read(channels.position.begin(), channels.position.end());
  read.insert(read.end(), channels.compared.begin(), channels.compared.end());
  read.insert(read.end(), channels.eigenfunctions.begin(), channels.eigenfunctions.begin() + eigenfunctions);
  PointValues values(places.rows(), static_cast<Eigen::Index>(read.size()));
  for_runs(places.rows(), threads, [&](Eigen::Index first, Eigen::Index last) {
    channels.samples.for_each_stencil(places.middleRows(first, last - first), [&](Eigen::Index i, const GridSamples::Stencil& stencil) {
      float* row = values.data() + (first + i) * values.cols();
      channels.samples.for_each_value(stencil, read, [row](std::size_t c, float value) { row[c] = value; });
    });
  });
  return values;
}

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

/// How many eigenfunctions are compared in a step.
class EigenfunctionCount {
 public:
  EigenfunctionCount(const ElasticChannels& source, const ElasticChannels& target, const ElasticParameters& parameters)
      : first_(parameters.eigenfunctions), more_(parameters.more_eigenfunctions) {
    if (parameters.spectrum > 0) stored_ = static_cast<int>(std::min(source.eigenfunctions.size(), target.eigenfunctions.size()));
  }
  [[nodiscard]] int operator()(int iteration) const { return std::min(stored_, first_ + more_ * iteration); }

 private:
  int first_, more_, stored_ = 0;
};

double longest(const Eigen::VectorXd& u) {
  double square = 0;
  for (Eigen::Index i = 0; i < u.size(); i += 2) square = std::max(square, u.segment<2>(i).squaredNorm());
  return std::sqrt(square);
}

}  // namespace

double flow_elastically(NodeMap& map, const ElasticChannels& source, const ElasticChannels& target, const HintDirections& hints,
                        const ElasticParameters& parameters, const Progress& progress, int threads) {
  struct Side {
    const ElasticChannels& channels;
    const Points& hints;
    Points places;
    PointValues values;
  };
  const NodeMesh& mesh = map.mesh();
  const auto signals = static_cast<Eigen::Index>(source.compared.size());
  const Eigen::RowVectorXf weights =
      (parameters.signals * Eigen::Map<const Eigen::RowVectorXd>(source.weights.data(), signals)).cast<float>();
  const EigenfunctionCount eigenfunctions(source, target, parameters);
  Side sides[2] = {{target, hints.target, map.target(), sample(target, eigenfunctions(0), map.target(), threads)},
                   {source, hints.source, map.source(), sample(source, eigenfunctions(1), map.source(), threads)}};
  double strain = 0;
  for (int iteration = 0; iteration < parameters.iterations; ++iteration) {
    progress.check();
    Side &moving = sides[iteration % 2], &resting = sides[(iteration + 1) % 2];
    const MovingSide t(moving.values, moving.places, mesh, threads);
    ElasticSystem system(mesh);
    system.add_strain(resting.values, t, parameters.area, parameters.yield, threads);
    strain = system.strain();
    system.add_differences(t, 3, moving.values.middleCols(3, signals) - resting.values.middleCols(3, signals), weights,
                           parameters.signal_yield, threads);
    if (const int k = eigenfunctions(iteration); k > 0) {
      const SpectralDifferences spectral = spectral_differences(resting.values.middleCols(3 + signals, k),
                                                                moving.values.middleCols(3 + signals, k), system.masses(), threads);
      system.add_differences(t, 3 + signals, spectral.values, static_cast<float>(parameters.spectrum / k) * spectral.explained, no_yield,
                             threads);
    }
    add_pairs(system, mesh.faces(), resting.places, resting.hints, moving.places, moving.hints, t.frames);
    const Eigen::VectorXd u = system.solve();
    const double move = longest(u);
    if (!std::isfinite(move)) break;
    moving.places = stepped(moving.places, u, t.frames, parameters.longest_move, mesh);
    if (move < parameters.settled) break;
    // It rests in the next step, and moves in the one after that.
    moving.values = sample(moving.channels, eigenfunctions(iteration + 2), moving.places, threads);
  }
  map.move_to(std::move(sides[1].places), std::move(sides[0].places));
  return strain;
}

}  // namespace spherematch
