#include "samples/remesh.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace spherematch::samples {
namespace {

constexpr int rounds_free = 10;    // from marched triangles to even ones
constexpr int rounds_pinned = 6;   // until they are even round pinned points
constexpr int rounds_polish = 10;  // flips and smoothing only

double largest_cosine(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto cosine = [](const Vec3& p, const Vec3& q, const Vec3& r) { return dot(q - p, r - p) / (norm(q - p) * norm(r - p)); };
  return std::max({cosine(a, b, c), cosine(b, c, a), cosine(c, a, b)});
}

class Remesher {
 public:
  Remesher(const Flesh& flesh, const Mesh& start, double scale) : flesh_(flesh), scale_(scale), mesh_(start) {
    for (int v = 0; v < mesh_.vertex_count(); ++v) edge_.push_back(wanted(mesh_.position(v)));
    pinned_.assign(edge_.size(), false);
  }

  void change_edges() {
    split_long();
    collapse_short();
    flip_for(&Remesher::evens_valences);
    smooth();
    for (int v = 0; v < mesh_.vertex_count(); ++v)
      if (mesh_.vertex_alive(v) && !pinned(v)) edge_[static_cast<std::size_t>(v)] = wanted(mesh_.position(v));
  }

  void polish() {
    flip_for(&Remesher::is_delaunay_better);
    smooth();
  }

  std::vector<int> pin(const std::vector<Vec3>& points) {
    std::vector<int> vertices;
    for (const Vec3& p : points) {
      const int v = nearest(p);
      if (pinned(v)) throw std::invalid_argument("two pinned points at one vertex");
      pinned_[static_cast<std::size_t>(v)] = true;
      vertices.push_back(v);
    }
    for (std::size_t i = 0; i < points.size(); ++i) mesh_.move(vertices[i], points[i]);
    return vertices;
  }

  [[nodiscard]] const SurfaceMesh& mesh() const { return mesh_; }

 private:
  [[nodiscard]] double wanted(const Vec3& p) const { return scale_ * flesh_.edge_length(p); }
  [[nodiscard]] bool pinned(int v) const { return pinned_[static_cast<std::size_t>(v)]; }
  [[nodiscard]] double edge(int v) const { return edge_[static_cast<std::size_t>(v)]; }
  /// Length of h in wanted edge lengths.
  [[nodiscard]] double relative_length(int h) const { return 2 * mesh_.length(h) / (edge(mesh_.origin(h)) + edge(mesh_.target(h))); }

  [[nodiscard]] int nearest(const Vec3& p) const {
    int best = -1;
    double best_distance = std::numeric_limits<double>::infinity();
    for (int v = 0; v < mesh_.vertex_count(); ++v) {
      if (!mesh_.vertex_alive(v) || distance(mesh_.position(v), p) >= best_distance) continue;
      best = v;
      best_distance = distance(mesh_.position(v), p);
    }
    return best;
  }

  void split_long() {
    const int count = mesh_.halfedge_count();
    for (int h = 0; h < count; ++h) {
      if (!mesh_.halfedge_alive(h) || relative_length(h) <= 4.0 / 3) continue;
      const Vec3 middle = flesh_.project(0.5 * (mesh_.position(mesh_.origin(h)) + mesh_.position(mesh_.target(h))));
      mesh_.split(h, middle);
      edge_.push_back(wanted(middle));
      pinned_.push_back(false);
    }
  }

  void collapse_short() {
    for (int h = 0; h < mesh_.halfedge_count(); ++h) {
      if (!mesh_.halfedge_alive(h) || relative_length(h) >= 4.0 / 5 || pinned(mesh_.origin(h))) continue;
      if (stays_good_without_origin(h) && mesh_.can_collapse(h)) mesh_.collapse(h);
    }
  }

  /// No face of the origin turns over or becomes long when the origin moves to the target.
  [[nodiscard]] bool stays_good_without_origin(int h) const {
    const int a = mesh_.origin(h), b = mesh_.target(h);
    for (const int out : mesh_.outgoing(a)) {
      const int c = mesh_.target(out), d = mesh_.apex(out);
      if (c == b || d == b) continue;
      const Vec3 before = mesh_.area_vector(out);
      const Vec3 after = cross(mesh_.position(c) - mesh_.position(b), mesh_.position(d) - mesh_.position(b));
      if (dot(before, after) <= 0.5 * norm(before) * norm(after)) return false;
      if (2 * distance(mesh_.position(b), mesh_.position(c)) > 4.0 / 3 * (edge(b) + edge(c))) return false;
    }
    return true;
  }

  /// Flips every edge that `gains` and whose new faces do not turn over.
  void flip_for(bool (Remesher::*gains)(int) const) {
    for (int h = 0; h < mesh_.halfedge_count(); ++h)
      if (mesh_.halfedge_alive(h) && h < mesh_.twin(h) && (this->*gains)(h) && flips_safely(h)) mesh_.flip(h);
  }

  [[nodiscard]] bool flips_safely(int h) const {
    const int g = mesh_.twin(h);
    const Vec3 &a = mesh_.position(mesh_.origin(h)), &b = mesh_.position(mesh_.target(h));
    const Vec3 &c = mesh_.position(mesh_.apex(h)), &d = mesh_.position(mesh_.apex(g));
    const Vec3 before = mesh_.area_vector(h) + mesh_.area_vector(g);
    const Vec3 one = cross(c - d, a - d), other = cross(d - c, b - c);
    const double least = 0.7 * norm(before);
    return mesh_.valence(mesh_.origin(h)) > 4 && mesh_.valence(mesh_.target(h)) > 4 && dot(before, one) > least * norm(one) &&
           dot(before, other) > least * norm(other);
  }

  [[nodiscard]] bool evens_valences(int h) const {
    int before = 0, after = 0;
    const auto count = [&](int v, int change) {
      const int excess = mesh_.valence(v) - 6;
      before += excess * excess;
      after += (excess + change) * (excess + change);
    };
    count(mesh_.origin(h), -1);
    count(mesh_.target(h), -1);
    count(mesh_.apex(h), 1);
    count(mesh_.apex(mesh_.twin(h)), 1);
    return after < before;
  }

  /// Whether the flip makes the smallest of the two faces' angles larger.
  [[nodiscard]] bool is_delaunay_better(int h) const {
    const Vec3 &a = mesh_.position(mesh_.origin(h)), &b = mesh_.position(mesh_.target(h));
    const Vec3 &c = mesh_.position(mesh_.apex(h)), &d = mesh_.position(mesh_.apex(mesh_.twin(h)));
    const double before = std::max(largest_cosine(a, b, c), largest_cosine(b, a, d));
    const double after = std::max(largest_cosine(a, d, c), largest_cosine(b, c, d));
    return after < before - 1e-9;
  }

  void smooth() {
    for (int v = 0; v < mesh_.vertex_count(); ++v) {
      if (!mesh_.vertex_alive(v) || pinned(v)) continue;
      Vec3 sum;
      double total = 0;
      for (const int out : mesh_.outgoing(v)) {
        const double area = norm(mesh_.area_vector(out));
        sum += (area / 3) * (mesh_.position(v) + mesh_.position(mesh_.target(out)) + mesh_.position(mesh_.apex(out)));
        total += area;
      }
      const Vec3 step = (1 / total) * sum - mesh_.position(v);
      const Vec3 normal = normalized(flesh_.sample(mesh_.position(v)).gradient);
      mesh_.move(v, flesh_.project(mesh_.position(v) + step - dot(step, normal) * normal));
    }
  }

  const Flesh& flesh_;
  double scale_;
  SurfaceMesh mesh_;
  std::vector<double> edge_;  // wanted edge length at each vertex
  std::vector<bool> pinned_;
};

}  // namespace

Mesh remesh(const Flesh& flesh, const Mesh& start, double scale) {
  Remesher remesher(flesh, start, scale);
  for (int i = 0; i < rounds_free; ++i) remesher.change_edges();
  return remesher.mesh().compact();
}

PinnedMesh remesh_with(const Flesh& flesh, const Mesh& start, double scale, const std::vector<Vec3>& points) {
  Remesher remesher(flesh, start, scale);
  std::vector<int> pinned = remesher.pin(points);
  for (int i = 0; i < rounds_pinned; ++i) remesher.change_edges();
  for (int i = 0; i < rounds_polish; ++i) remesher.polish();
  std::vector<int> number;
  PinnedMesh result{remesher.mesh().compact(&number), std::move(pinned)};
  for (int& v : result.pinned) v = number[static_cast<std::size_t>(v)];
  return result;
}

}  // namespace spherematch::samples
