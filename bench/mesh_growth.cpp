#include "bench/mesh_growth.h"

#include <array>
#include <optional>
#include <queue>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/mesh/decimate.h"
#include "engine/mesh/topology.h"

namespace spherematch::bench {

namespace {

/// Half-edge h of face h / 3 runs from its corner h % 3 to the next.
using HalfEdge = std::int32_t;

constexpr HalfEdge next_of(HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; }

/// Halves edges of a closed mesh, the longest first.
class EdgeBisection {
 public:
  EdgeBisection(const TriMesh& mesh, std::int32_t vertices);
  void run();
  [[nodiscard]] TriMesh mesh() const;

 private:
  /// An edge as it was when it came into the queue.
  struct Entry {
    double squared_length = 0;
    std::int32_t low = 0;  ///< its ends, the lower index first
    std::int32_t high = 0;
    HalfEdge half = 0;  ///< one of its sides

    /// Of equally long edges that between the lowest vertices is halved first, wherever the queue has them.
    bool operator<(const Entry& other) const {
      return std::tie(squared_length, other.low, other.high, other.half) < std::tie(other.squared_length, low, high, half);
    }
  };

  [[nodiscard]] std::int32_t& from(HalfEdge h) { return corners_[static_cast<std::size_t>(h)]; }
  [[nodiscard]] std::int32_t to(HalfEdge h) { return from(next_of(h)); }
  [[nodiscard]] HalfEdge& twin(HalfEdge h) { return twins_[static_cast<std::size_t>(h)]; }
  void join(HalfEdge a, HalfEdge b) {
    twin(a) = b;
    twin(b) = a;
  }
  [[nodiscard]] Eigen::Map<const Eigen::Vector3d> place(std::int32_t vertex) const {
    return Eigen::Map<const Eigen::Vector3d>(places_[static_cast<std::size_t>(vertex)].data());
  }
  void find_twins(const Triangles& faces);
  [[nodiscard]] Entry entry_of(HalfEdge h);
  [[nodiscard]] bool is_current(const Entry& entry);
  void halve(HalfEdge h);
  HalfEdge split_face(HalfEdge h, std::int32_t middle);

  std::vector<std::array<double, 3>> places_;
  std::vector<std::int32_t> corners_;  ///< per half-edge: where it begins
  std::vector<HalfEdge> twins_;        ///< per half-edge: the same edge on the other side
  std::priority_queue<Entry> queue_;
  std::size_t wanted_;
};

EdgeBisection::EdgeBisection(const TriMesh& mesh, std::int32_t vertices) : wanted_(static_cast<std::size_t>(vertices)) {
  places_.reserve(wanted_);
  for (Eigen::Index i = 0; i < mesh.vertex_count(); ++i) {
    places_.push_back({mesh.vertices(i, 0), mesh.vertices(i, 1), mesh.vertices(i, 2)});
  }
  corners_.assign(mesh.faces.data(), mesh.faces.data() + mesh.faces.size());
  twins_.resize(corners_.size());
  find_twins(mesh.faces);
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(corners_.size()); ++h) {
    if (from(h) < to(h)) queue_.push(entry_of(h));
  }
}

void EdgeBisection::find_twins(const Triangles& faces) {
  const Triangles neighbours = face_neighbours(faces);
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(corners_.size()); ++h) {
    const std::int32_t neighbour = neighbours(h / 3, h % 3);
    if (neighbour < 0) throw std::runtime_error("only a closed mesh can be subdivided");
    for (HalfEdge other = 3 * neighbour; other < 3 * neighbour + 3; ++other) {
      if (from(other) == to(h) && to(other) == from(h)) twin(h) = other;
    }
  }
}

EdgeBisection::Entry EdgeBisection::entry_of(HalfEdge h) {
  const auto [low, high] = std::minmax({from(h), to(h)});
  return {.squared_length = (place(low) - place(high)).squaredNorm(), .low = low, .high = high, .half = h};
}

/// False once the edge was halved; each edge has an entry at the place where it is now.
bool EdgeBisection::is_current(const Entry& entry) {
  const auto [low, high] = std::minmax({from(entry.half), to(entry.half)});
  return low == entry.low && high == entry.high;
}

/// Splits the face of h = (p, q) into (p, m, r) at its old place and (m, q, r) at a new one. Returns the half-edge (m, q).
HalfEdge EdgeBisection::split_face(HalfEdge h, std::int32_t middle) {
  const HalfEdge after = next_of(h);
  const std::int32_t tip = to(after);
  const auto added = static_cast<HalfEdge>(corners_.size());
  corners_.insert(corners_.end(), {middle, from(after), tip});
  twins_.resize(corners_.size());
  join(added + 1, twin(after));
  join(added + 2, after);
  from(after) = middle;
  queue_.push(entry_of(added + 1));  // it moved
  queue_.push(entry_of(added + 2));
  return added;
}

void EdgeBisection::halve(HalfEdge h) {
  const HalfEdge opposite = twin(h);
  const Eigen::Vector3d centre = (place(from(h)) + place(to(h))) / 2;
  const auto middle = static_cast<std::int32_t>(places_.size());
  places_.push_back({centre.x(), centre.y(), centre.z()});
  const HalfEdge far_half = split_face(h, middle);
  const HalfEdge far_opposite = split_face(opposite, middle);
  join(h, far_opposite);
  join(opposite, far_half);
  queue_.push(entry_of(h));
  queue_.push(entry_of(opposite));
}

void EdgeBisection::run() {
  while (places_.size() < wanted_) {
    const Entry entry = queue_.top();
    queue_.pop();
    if (is_current(entry)) halve(entry.half);
  }
}

TriMesh EdgeBisection::mesh() const {
  TriMesh mesh;
  mesh.vertices = Eigen::Map<const Points>(places_.front().data(), static_cast<Eigen::Index>(places_.size()), 3);
  mesh.faces = Eigen::Map<const Triangles>(corners_.data(), static_cast<Eigen::Index>(corners_.size() / 3), 3);
  return mesh;
}

}  // namespace

TriMesh subdivided(const TriMesh& mesh, std::int32_t vertices) {
  if (mesh.vertex_count() >= vertices) return mesh;
  EdgeBisection bisection(mesh, vertices);
  bisection.run();
  return bisection.mesh();
}

TriMesh resized(const TriMesh& mesh, std::int32_t vertices) {
  if (mesh.vertex_count() <= vertices) return subdivided(mesh, vertices);
  std::optional<DecimatedMesh> smaller = decimate(mesh, vertices);
  if (!smaller || smaller->mesh.vertex_count() != vertices) {
    throw std::runtime_error("the mesh cannot be brought down to " + std::to_string(vertices) + " vertices");
  }
  return std::move(smaller->mesh);
}

}  // namespace spherematch::bench
