#include "samples/landmarks.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <stdexcept>
#include <utility>

namespace spherematch::samples {
namespace {

/// Distances along the edges from all points chosen so far.
class EdgeDistances {
 public:
  explicit EdgeDistances(const Mesh& mesh)
      : mesh_(mesh), neighbours_(mesh.vertices.size()), distance_(mesh.vertices.size(), std::numeric_limits<double>::infinity()) {
    for (const Triangle& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) neighbours_[static_cast<std::size_t>(t[i])].push_back(static_cast<std::size_t>(t[(i + 1) % 3]));
  }

  [[nodiscard]] double operator[](std::size_t v) const { return distance_[v]; }

  void add_source(std::size_t source) {
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    distance_[source] = 0;
    queue.emplace(0, source);
    while (!queue.empty()) {
      const auto [d, v] = queue.top();
      queue.pop();
      if (d > distance_[v]) continue;
      for (const std::size_t w : neighbours_[v]) {
        const double through = d + distance(mesh_.vertices[v], mesh_.vertices[w]);
        if (through >= distance_[w]) continue;
        distance_[w] = through;
        queue.emplace(through, w);
      }
    }
  }

 private:
  const Mesh& mesh_;
  std::vector<std::vector<std::size_t>> neighbours_;
  std::vector<double> distance_;
};

std::size_t nearest_vertex(const Mesh& mesh, const Vec3& p) {
  std::size_t best = 0;
  for (std::size_t v = 1; v < mesh.vertices.size(); ++v)
    if (distance(mesh.vertices[v], p) < distance(mesh.vertices[best], p)) best = v;
  return best;
}

}  // namespace

bool is_in(const std::vector<Ball>& balls, const Vec3& p) {
  return std::any_of(balls.begin(), balls.end(), [&](const Ball& b) { return distance(b.centre, p) < b.radius; });
}

Landmarks spread_landmarks(const Flesh& flesh, const Mesh& mesh, std::size_t count, const std::vector<Ball>& avoided) {
  std::vector<std::size_t> candidates;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3& p = mesh.vertices[v];
    if (p.x >= 0 && !is_in(avoided, p) && !is_in(avoided, mirrored(p))) candidates.push_back(v);
  }
  Landmarks landmarks;
  EdgeDistances distances(mesh);
  while (landmarks.points.size() < count) {
    if (candidates.empty()) throw std::invalid_argument("no room for so many landmarks");
    const auto far =
        std::max_element(candidates.begin(), candidates.end(), [&](std::size_t a, std::size_t b) { return distances[a] < distances[b]; });
    const Vec3 vertex = mesh.vertices[*far];
    const double edge = flesh.edge_length(vertex);
    const bool in_the_middle = vertex.x < 0.8 * edge;  // too near its own mirror image to be a pair
    const Vec3 p = in_the_middle ? flesh.project({0, vertex.y, vertex.z}) : vertex;
    if (std::any_of(landmarks.points.begin(), landmarks.points.end(), [&](const Vec3& q) { return distance(p, q) < 1.5 * edge; })) {
      candidates.erase(far);
      continue;
    }
    const int index = static_cast<int>(landmarks.points.size());
    distances.add_source(*far);
    landmarks.points.push_back(p);
    landmarks.mirror.push_back(index);
    if (in_the_middle) continue;
    distances.add_source(nearest_vertex(mesh, mirrored(p)));
    landmarks.points.push_back(mirrored(p));
    landmarks.mirror.back() = index + 1;
    landmarks.mirror.push_back(index);
  }
  return landmarks;
}

}  // namespace spherematch::samples
