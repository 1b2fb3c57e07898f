#include "engine/evaluate/geodesics.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/mesh/topology.h"

namespace spherematch {

namespace {

/// The straight way from `left` to `right`, the corners opposite the edge from `a` to `b`, with both faces turned about that edge
/// into one plane; nothing where it leaves the two faces.
std::optional<double> unfolded_distance(const Eigen::RowVector3d& a, const Eigen::RowVector3d& b, const Eigen::RowVector3d& left,
                                        const Eigen::RowVector3d& right) {
  const Eigen::RowVector3d edge = b - a;
  const double length = edge.norm();
  if (!(length > 0)) return std::nullopt;
  const Eigen::RowVector3d along = edge / length;
  const double left_x = (left - a).dot(along), right_x = (right - a).dot(along);
  const double left_y = (left - a).cross(along).norm(), right_y = (right - a).cross(along).norm();
  if (!(left_y + right_y > 0)) return std::nullopt;
  const double crossing = left_x + (right_x - left_x) * left_y / (left_y + right_y);
  if (crossing <= 0 || crossing >= length) return std::nullopt;
  return std::hypot(left_x - right_x, left_y + right_y);
}

}  // namespace

void GeodesicGraph::add(std::vector<std::vector<Step>>& steps, std::int32_t a, std::int32_t b, double length) {
  steps[static_cast<std::size_t>(a)].push_back({b, length});
  steps[static_cast<std::size_t>(b)].push_back({a, length});
}

GeodesicGraph::GeodesicGraph(const TriMesh& mesh) {
  std::vector<std::vector<Step>> steps(static_cast<std::size_t>(mesh.vertex_count()));
  const Triangles neighbours = face_neighbours(mesh.faces);
  const auto point = [&](std::int32_t v) { return mesh.vertices.row(v); };
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3), left = mesh.faces(f, (k + 2) % 3);
      const std::int32_t other = neighbours(f, k);
      if (other > f) continue;  // each edge once, from the later of its faces
      add(steps, a, b, (point(a) - point(b)).norm());
      if (other < 0) continue;
      const std::int32_t right = mesh.faces.row(other).sum() - a - b;
      if (const auto length = unfolded_distance(point(a), point(b), point(left), point(right))) add(steps, left, right, *length);
    }
  }
  offsets_.push_back(0);
  for (const std::vector<Step>& from : steps) {
    steps_.insert(steps_.end(), from.begin(), from.end());
    offsets_.push_back(static_cast<std::int32_t>(steps_.size()));
  }
}

std::vector<double> GeodesicGraph::distances(std::int32_t source, std::span<const std::int32_t> targets) const {
  const GeodesicSearch::Start start{source, 0};
  return GeodesicSearch(*this).distances(std::span(&start, 1), targets);
}

GeodesicSearch::GeodesicSearch(const GeodesicGraph& graph)
    : graph_(graph),
      distance_(graph.offsets_.size() - 1, std::numeric_limits<double>::infinity()),
      wanted_(graph.offsets_.size() - 1, false) {}

void GeodesicSearch::reach(Queue& queue, std::int32_t vertex, double length) {
  double& known = distance_[static_cast<std::size_t>(vertex)];
  if (length >= known) return;
  if (known == std::numeric_limits<double>::infinity()) touched_.push_back(vertex);
  known = length;
  queue.emplace(length, vertex);
}

std::vector<double> GeodesicSearch::distances(std::span<const Start> starts, std::span<const std::int32_t> targets) {
  std::size_t missing = 0;
  for (const std::int32_t target : targets) {
    missing += wanted_[static_cast<std::size_t>(target)] ? 0 : 1;
    wanted_[static_cast<std::size_t>(target)] = true;
  }
  Queue queue;
  for (const Start& start : starts) reach(queue, start.vertex, start.length);
  while (!queue.empty() && missing > 0) {
    const auto [length, vertex] = queue.top();
    queue.pop();
    const auto v = static_cast<std::size_t>(vertex);
    if (length > distance_[v]) continue;
    if (wanted_[v]) --missing;
    for (auto i = graph_.offsets_[v]; i < graph_.offsets_[v + 1]; ++i) {
      const GeodesicGraph::Step& step = graph_.steps_[static_cast<std::size_t>(i)];
      reach(queue, step.to, length + step.length);
    }
  }
  std::vector<double> result;
  for (const std::int32_t target : targets) {
    result.push_back(distance_[static_cast<std::size_t>(target)]);
    wanted_[static_cast<std::size_t>(target)] = false;
  }
  for (const std::int32_t vertex : touched_) distance_[static_cast<std::size_t>(vertex)] = std::numeric_limits<double>::infinity();
  touched_.clear();
  return result;
}

}  // namespace spherematch
