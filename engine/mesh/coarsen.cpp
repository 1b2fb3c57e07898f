#include "engine/mesh/coarsen.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "engine/mesh/closest_point.h"
#include "engine/mesh/half_edges.h"
#include "engine/mesh/laplacian.h"
#include "engine/mesh/topology.h"

namespace spherematch {
namespace {

constexpr std::int32_t kMostSpokes = 16;     // of a vertex to be removed
constexpr std::int32_t kMostValence = 11;    // that a removal may give to a vertex
constexpr std::int32_t kMostSeenFaces = 64;  // of one star, in the search for places
constexpr double kGoodShape = 0.12;          // of triangles that a removal may make in any case; see shape_of()
constexpr double kPoorShape = 1e-4;          // the same, where better ones cannot be made
constexpr double kFarthest = 0.5;            // a removed vertex may be from the surface, in mean edges at the end
constexpr double kLongest = 3;               // squared length of an edge over that of the mean one at the end

std::size_t at(std::int64_t index) { return static_cast<std::size_t>(index); }

/// Square of the area over that of the equilateral triangle with the same sum of squared edges: 1 at best, 0 without area.
double shape_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, double squared_normal) {
  const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return squares > 0 ? 12 * squared_normal / (squares * squares) : 0;
}

class Coarsener {
 public:
  explicit Coarsener(const TriMesh& fine)
      : points_(fine.vertices),
        mesh_(fine.faces, fine.vertex_count()),
        live_(at(fine.vertex_count())),
        into_(live_.size()),
        error_(live_.size(), 0.0) {
    std::iota(live_.begin(), live_.end(), 0);
    std::iota(into_.begin(), into_.end(), 0);
    area_ = face_areas(fine.vertices, fine.faces).sum();
  }

  /// Removes vertices until `wanted` are left; false when that cannot be done.
  bool reduce(std::size_t wanted, const Progress& progress) {
    bool strict = true;
    const double mean = area_ * 2 / std::sqrt(3.0) / static_cast<double>(wanted);
    longest_ = kLongest * mean;
    farthest_ = kFarthest * std::sqrt(mean);
    locked_.assign(into_.size(), 0);
    while (live_.size() > wanted) {
      progress.check();
      const std::size_t removed = sweep(live_.size() - wanted, strict);
      if (removed * 50 >= live_.size() || removed + wanted >= live_.size()) continue;
      // Too little: what is left to remove is between bad triangles, or crowded round few vertices.
      if (!strict && removed == 0) return false;
      if (!strict && ++poor_rounds_ > 200) return false;
      strict = false;
    }
    return true;
  }

  [[nodiscard]] const HalfEdges& mesh() const { return mesh_; }
  [[nodiscard]] const std::vector<std::int32_t>& live() const { return live_; }

  /// The vertex left that `v` went into, at last.
  std::int32_t home(std::int32_t v) {
    while (into_[at(v)] != v) v = into_[at(v)] = into_[at(into_[at(v)])];
    return v;
  }

 private:
  /// One round: among the half of the vertices with the shortest edges, each whose neighbours all stay.
  std::size_t sweep(std::size_t most, bool strict) {
    ++round_;
    shortest_.clear();
    for (const std::int32_t v : live_) shortest_.push_back(shortest_edge(v));
    std::vector<double> sorted = shortest_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(strict ? sorted.size() / 2 : sorted.size() - 1);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double bound = *middle;
    std::size_t removed = 0;
    for (std::size_t i = 0; i < live_.size() && removed < most; ++i)
      if (shortest_[i] <= bound && locked_[at(live_[i])] != round_ && remove(live_[i], strict)) ++removed;
    std::erase_if(live_, [this](std::int32_t v) { return into_[at(v)] != v; });
    return removed;
  }

  /// Squared. Of a vertex of very many faces, which is not removed, infinite.
  double shortest_edge(std::int32_t v) {
    double shortest = std::numeric_limits<double>::infinity();
    if (mesh_.valence(v) > kMostSpokes) return shortest;
    const Eigen::Vector3d center = point(v);
    mesh_.for_each_spoke(v, [&](std::int32_t spoke) { shortest = std::min(shortest, (point(mesh_.head(spoke)) - center).squaredNorm()); });
    return shortest;
  }

  bool remove(std::int32_t v, bool strict) {
    if (mesh_.valence(v) > kMostSpokes) return false;
    ring_.clear();
    mesh_.for_each_spoke(v, [&](std::int32_t spoke) { ring_.push_back({spoke, mesh_.head(spoke), point(mesh_.head(spoke))}); });
    look_at_star(v);
    const double longest = strict ? std::max(longest_, longest_spoke_) : std::numeric_limits<double>::infinity();
    std::int32_t best = -1;
    std::size_t best_at = 0;
    double best_shape = std::min(strict ? kGoodShape : kPoorShape, worst_shape_);
    for (std::size_t k = 0; k < ring_.size(); ++k) {
      const double shape = shape_after(k, best_shape, longest);
      if ((shape > best_shape || (shape == 0 && best_shape == 0)) && is_allowed(v, k)) {
        best_shape = shape;
        best = ring_[k].spoke;
        best_at = k;
      }
    }
    if (best < 0) return false;
    const double error = error_[at(v)] + distance_to_patch(v, best_at);
    if (strict && error > farthest_) return false;
    into_[at(v)] = mesh_.head(best);
    mesh_.collapse(best);
    for (const Spoke& spoke : ring_) {
      locked_[at(spoke.vertex)] = round_;
      error_[at(spoke.vertex)] = std::max(error_[at(spoke.vertex)], error);
    }
    return true;
  }

  /// Normals of the faces round v, in the order of the ring, their worst shape and the longest spoke.
  void look_at_star(std::int32_t v) {
    const Eigen::Vector3d center = point(v);
    normals_.clear();
    worst_shape_ = std::numeric_limits<double>::infinity();
    longest_spoke_ = 0;
    for (std::size_t k = 0; k < ring_.size(); ++k) {
      const Eigen::Vector3d &a = ring_[k].point, &b = ring_[(k + 1) % ring_.size()].point;
      normals_.emplace_back((a - center).cross(b - center));
      longest_spoke_ = std::max(longest_spoke_, (a - center).squaredNorm());
      worst_shape_ = std::min(worst_shape_, shape_of(center, a, b, normals_.back().squaredNorm()));
    }
  }

  /// The worst shape of the faces when the vertex goes into neighbour k, or some value up to `least` when it is no better than that;
  /// -1 when a face turns over or a new edge is longer than the root of `longest`.
  [[nodiscard]] double shape_after(std::size_t k, double least, double longest) const {
    constexpr double kMostTurn = 0.04;  // squared cosine between a face before and after
    const std::size_t size = ring_.size();
    const Eigen::Vector3d& apex = ring_[k].point;
    double worst = std::numeric_limits<double>::infinity();
    for (std::size_t i = (k + 1) % size; (i + 1) % size != k && worst >= least; i = (i + 1) % size) {
      const Eigen::Vector3d &a = ring_[i].point, &b = ring_[(i + 1) % size].point;
      const Eigen::Vector3d normal = (a - apex).cross(b - apex);
      const double cosine = normal.dot(normals_[i]), squared = normal.squaredNorm();
      if (!(cosine >= 0 && cosine * cosine >= kMostTurn * squared * normals_[i].squaredNorm())) return -1;
      if ((i + 2) % size != k && (b - apex).squaredNorm() > longest) return -1;
      worst = std::min(worst, shape_of(apex, a, b, squared));
    }
    return worst;
  }

  /// Of v from the faces round it when it goes into neighbour k.
  [[nodiscard]] double distance_to_patch(std::int32_t v, std::size_t k) const {
    const std::size_t size = ring_.size();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = (k + 1) % size; (i + 1) % size != k; i = (i + 1) % size) {
      const std::array<Eigen::Vector3d, 3> corners{ring_[k].point, ring_[i].point, ring_[(i + 1) % size].point};
      const std::array<double, 3> weights = nearest_weights(corners, point(v));
      least = std::min(least, (weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2] - point(v)).squaredNorm());
    }
    return std::sqrt(least);
  }

  /// The mesh stays a manifold without double edges, and no vertex gets too many faces.
  bool is_allowed(std::int32_t v, std::size_t k) {
    const std::size_t size = ring_.size();
    const std::int32_t w = ring_[k].vertex, left = ring_[(k + 1) % size].vertex, right = ring_[(k + size - 1) % size].vertex;
    if (mesh_.valence(left) <= 3 || mesh_.valence(right) <= 3) return false;
    if (size == 3) return true;
    const std::int32_t after = mesh_.valence(w) + static_cast<std::int32_t>(size) - 4;
    if (after > std::max(kMostValence, mesh_.valence(w)) || mesh_.valence(w) > kMostSeenFaces) return false;
    int common = 0;
    mesh_.for_each_spoke(w, [&](std::int32_t spoke) {
      const std::int32_t u = mesh_.head(spoke);
      for (const Spoke& other : ring_) common += other.vertex == u ? 1 : 0;
    });
    return common == 2 && mesh_.valence(v) < static_cast<std::int32_t>(live_.size()) - 1;
  }

  [[nodiscard]] Eigen::Vector3d point(std::int32_t v) const { return points_.row(v); }

  struct Spoke {
    std::int32_t spoke;
    std::int32_t vertex;
    Eigen::Vector3d point;
  };

  const Points& points_;
  HalfEdges mesh_;
  std::vector<std::int32_t> live_;  ///< vertices left, rising
  std::vector<std::int32_t> into_;  ///< per vertex: itself, or what it went into
  std::vector<std::int32_t> locked_;
  std::vector<double> shortest_;
  std::vector<Spoke> ring_;
  std::vector<Eigen::Vector3d> normals_;
  double worst_shape_ = 0, longest_spoke_ = 0;  ///< of the star looked at; squared
  std::vector<double> error_;                   ///< per vertex: how far vertices removed near it may be from the surface
  double farthest_ = 0;                         ///< that this may become while there are better removals
  double area_ = 0;                             ///< of the fine mesh
  double longest_ = 0;                          ///< edge to be made while better ones can be; squared
  std::int32_t round_ = 0;
  int poor_rounds_ = 0;
};

/// Finds nearest points by walking over the coarse mesh.
class Walker {
 public:
  explicit Walker(const TriMesh& mesh) : mesh_(mesh), around_(vertex_faces(mesh.faces, mesh.vertex_count())) {
    normals_.reserve(at(mesh.face_count()));
    for (std::int32_t f = 0; f < mesh.face_count(); ++f)
      normals_.emplace_back((corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0)));
  }

  /// From star to star, beginning round `vertex`, while that leads to a face that looks the way of `normal`, or nearer to `point`.
  [[nodiscard]] SurfacePoint nearest(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, std::int32_t vertex) const {
    SurfacePoint best{around_.of(vertex)[0], corner_weights(around_.of(vertex)[0], vertex)};
    Rank rank;
    for (std::int32_t from = -1; vertex != from;) {
      from = vertex;
      const std::span<const std::int32_t> star = around_.of(vertex);
      for (const std::int32_t face : star.first(std::min(star.size(), at(kMostSeenFaces)))) visit(face, point, normal, best, rank);
      vertex = mesh_.faces(best.face, std::max_element(best.weights.begin(), best.weights.end()) - best.weights.begin());
    }
    return best;
  }

  [[nodiscard]] SurfacePoint at_vertex(std::int32_t vertex) const {
    const std::int32_t face = around_.of(vertex)[0];
    return {face, corner_weights(face, vertex)};
  }

 private:
  struct Rank {
    bool turned = true;
    double distance = std::numeric_limits<double>::infinity();
  };

  void visit(std::int32_t face, const Eigen::Vector3d& point, const Eigen::Vector3d& normal, SurfacePoint& best, Rank& rank) const {
    const bool turned = normals_[at(face)].dot(normal) <= 0;
    if (turned && !rank.turned) return;
    const std::array<Eigen::Vector3d, 3> corners{corner(face, 0), corner(face, 1), corner(face, 2)};
    const std::array<double, 3> weights = nearest_weights(corners, point);
    const double distance = (weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2] - point).squaredNorm();
    if (turned == rank.turned && !(distance < rank.distance)) return;
    rank = {turned, distance};
    best = {face, weights};
  }

  [[nodiscard]] std::array<double, 3> corner_weights(std::int32_t face, std::int32_t vertex) const {
    std::array<double, 3> weights{};
    for (int k = 0; k < 3; ++k) weights[at(k)] = mesh_.faces(face, k) == vertex ? 1 : 0;
    return weights;
  }

  [[nodiscard]] Eigen::Vector3d corner(std::int32_t face, int k) const { return mesh_.vertices.row(mesh_.faces(face, k)); }

  const TriMesh& mesh_;
  VertexFaces around_;
  std::vector<Eigen::Vector3d> normals_;
};

/// Area-weighted, of any length.
Points vertex_normals(const TriMesh& mesh) {
  Points normals = Points::Zero(mesh.vertex_count(), 3);
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const Eigen::RowVector3d a = mesh.vertices.row(mesh.faces(f, 0)), b = mesh.vertices.row(mesh.faces(f, 1)),
                             c = mesh.vertices.row(mesh.faces(f, 2));
    for (int k = 0; k < 3; ++k) normals.row(mesh.faces(f, k)) += (b - a).cross(c - a);
  }
  return normals;
}

/// What is left of the mesh; `number` gets the new number of each vertex that is left.
TriMesh remaining(const HalfEdges& mesh, const Points& points, const std::vector<std::int32_t>& live, std::vector<std::int32_t>& number) {
  TriMesh result;
  result.vertices.resize(static_cast<Eigen::Index>(live.size()), 3);
  result.faces.resize(static_cast<Eigen::Index>(2 * live.size() - 4), 3);
  for (std::size_t i = 0; i < live.size(); ++i) {
    result.vertices.row(static_cast<Eigen::Index>(i)) = points.row(live[i]);
    number[at(live[i])] = static_cast<std::int32_t>(i);
  }
  Eigen::Index row = 0;
  mesh.for_each_face([&](const std::array<std::int32_t, 3>& corners) {
    for (int k = 0; k < 3; ++k) result.faces(row, k) = number[at(corners[at(k)])];
    ++row;
  });
  return result;
}

/// Vertices along a curve that fills space (Morton's), so that neighbours are near each other in memory: on large meshes, several times
/// faster.
std::vector<std::int32_t> spatial_order(const Points& points) {
  constexpr double kCells = 1024;  // a side: ten bits
  const Eigen::RowVector3d low = points.colwise().minCoeff();
  const double size = (points.colwise().maxCoeff() - low).maxCoeff(), scale = size > 0 ? (kCells - 1) / size : 0;
  const auto spread = [](std::uint64_t bits) {  // two zeros after each of ten bits
    bits = (bits | bits << 16) & 0x030000FF;
    bits = (bits | bits << 8) & 0x0300F00F;
    bits = (bits | bits << 4) & 0x030C30C3;
    return (bits | bits << 2) & 0x09249249;
  };
  std::vector<std::uint64_t> keys(at(points.rows()));
  for (std::size_t v = 0; v < keys.size(); ++v) {
    const Eigen::RowVector3d cell = (points.row(static_cast<Eigen::Index>(v)) - low) * scale;
    std::uint64_t code = 0;
    for (int k = 0; k < 3; ++k) code |= spread(static_cast<std::uint64_t>(cell[k])) << k;
    keys[v] = code << 32 | v;
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::int32_t> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](std::uint64_t key) { return static_cast<std::int32_t>(key & 0xFFFFFFFF); });
  return order;
}

/// Row i of the result is vertex order[i]; faces go by their lowest vertex.
TriMesh renumbered(const TriMesh& mesh, const std::vector<std::int32_t>& order) {
  TriMesh result{Points(mesh.vertex_count(), 3), Triangles(mesh.face_count(), 3)};
  std::vector<std::int32_t> number(order.size()), start(order.size() + 1, 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    number[at(order[i])] = static_cast<std::int32_t>(i);
    result.vertices.row(static_cast<Eigen::Index>(i)) = mesh.vertices.row(order[i]);
  }
  const auto corners = [&](Eigen::Index f) {
    return Eigen::RowVector3i(number[at(mesh.faces(f, 0))], number[at(mesh.faces(f, 1))], number[at(mesh.faces(f, 2))]);
  };
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) ++start[at(corners(f).minCoeff()) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const Eigen::RowVector3i c = corners(f);
    result.faces.row(start[at(c.minCoeff())]++) = c;
  }
  return result;
}

/// coarsen(), of a mesh whose numbering follows the surface.
std::optional<CoarseMesh> coarsen_local(const TriMesh& fine, std::int32_t vertices, const Progress& progress) {
  Coarsener coarsener(fine);
  if (!coarsener.reduce(at(vertices), progress)) return std::nullopt;

  std::vector<std::int32_t> number(at(fine.vertex_count()), -1);
  CoarseMesh result{remaining(coarsener.mesh(), fine.vertices, coarsener.live(), number), coarsener.live(), {}};
  const Points normals = vertex_normals(fine);
  const Walker walker(result.mesh);
  result.places.reserve(number.size());
  for (std::int32_t v = 0; v < fine.vertex_count(); ++v) {
    if (v % 16384 == 0) progress.check();
    const std::int32_t kept = number[at(v)];
    result.places.push_back(kept >= 0 ? walker.at_vertex(kept)
                                      : walker.nearest(fine.vertices.row(v), normals.row(v), number[at(coarsener.home(v))]));
  }
  return result;
}

}  // namespace

std::optional<CoarseMesh> coarsen(const TriMesh& fine, std::int32_t vertices, const Progress& progress) {
  if (fine.vertex_count() <= vertices) return std::nullopt;
  const std::vector<std::int32_t> order = spatial_order(fine.vertices);
  std::optional<CoarseMesh> result = coarsen_local(renumbered(fine, order), vertices, progress);
  if (!result) return result;
  for (std::int32_t& v : result->fine_vertex) v = order[at(v)];
  std::vector<SurfacePoint> places(result->places.size());
  for (std::size_t i = 0; i < places.size(); ++i) places[at(order[i])] = result->places[i];
  result->places = std::move(places);
  return result;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> interpolation(const CoarseMesh& coarse) {
  Eigen::SparseMatrix<double, Eigen::RowMajor> result(static_cast<Eigen::Index>(coarse.places.size()), coarse.mesh.vertex_count());
  result.reserve(Eigen::VectorXi::Constant(result.rows(), 3));
  for (std::size_t v = 0; v < coarse.places.size(); ++v)
    for (int k = 0; k < 3; ++k) {
      const double weight = coarse.places[v].weights[at(k)];
      if (weight > 0) result.insert(static_cast<Eigen::Index>(v), coarse.mesh.faces(coarse.places[v].face, k)) = weight;
    }
  result.makeCompressed();
  return result;
}

}  // namespace spherematch
