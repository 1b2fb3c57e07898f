#include "engine/mesh/topology.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "engine/data/error.h"

namespace spherematch {

namespace {

struct EdgeUse {
  std::int32_t low;
  std::int32_t high;
  std::int32_t half_edge;  ///< 3 * face + corner it starts at
  bool operator<(const EdgeUse& other) const { return std::tie(low, high, half_edge) < std::tie(other.low, other.high, other.half_edge); }
};

std::vector<EdgeUse> sorted_edges(const Triangles& faces) {
  std::vector<EdgeUse> edges;
  edges.reserve(static_cast<std::size_t>(faces.size()));
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({faces(f, k), faces(f, (k + 1) % 3)});
      edges.push_back({low, high, static_cast<std::int32_t>(3 * f + k)});
    }
  std::sort(edges.begin(), edges.end());
  return edges;
}

bool same_edge(const EdgeUse& a, const EdgeUse& b) { return a.low == b.low && a.high == b.high; }

}  // namespace

VertexFaces vertex_faces(const Triangles& faces, Eigen::Index vertex_count) {
  VertexFaces result;
  result.offsets.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  result.faces.resize(static_cast<std::size_t>(faces.size()));
  for (Eigen::Index i = 0; i < faces.size(); ++i) ++result.offsets[static_cast<std::size_t>(faces.data()[i]) + 1];
  for (std::size_t v = 1; v < result.offsets.size(); ++v) result.offsets[v] += result.offsets[v - 1];
  std::vector<std::int32_t> next(result.offsets.begin(), result.offsets.end() - 1);
  for (Eigen::Index i = 0; i < faces.size(); ++i) {
    std::int32_t& slot = next[static_cast<std::size_t>(faces.data()[i])];
    result.faces[static_cast<std::size_t>(slot++)] = static_cast<std::int32_t>(i / 3);
  }
  return result;
}

Triangles face_neighbours(const Triangles& faces) {
  Triangles neighbours = Triangles::Constant(faces.rows(), 3, -1);
  const std::vector<EdgeUse> edges = sorted_edges(faces);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && same_edge(edges[i], edges[end])) ++end;
    const auto start = [&](std::size_t e) { return faces.data()[edges[e].half_edge]; };
    if (end - i > 2 || (end - i == 2 && start(i) == start(i + 1)))
      throw EngineError(ErrorCode::non_manifold, std::to_string(end - i) + " faces meet at an edge, or two run along it the same way",
                        {.vertices = {}, .faces = {}, .edges = {{edges[i].low, edges[i].high}}});
    if (end - i == 2) {
      neighbours.data()[edges[i].half_edge] = edges[i + 1].half_edge / 3;
      neighbours.data()[edges[i + 1].half_edge] = edges[i].half_edge / 3;
    }
    i = end;
  }
  return neighbours;
}

std::int64_t euler_characteristic(const Triangles& faces) {
  if (faces.rows() == 0) return 0;
  std::vector<EdgeUse> edges = sorted_edges(faces);
  edges.erase(std::unique(edges.begin(), edges.end(), same_edge), edges.end());
  std::vector<bool> used(static_cast<std::size_t>(faces.maxCoeff()) + 1, false);
  for (Eigen::Index i = 0; i < faces.size(); ++i) used[static_cast<std::size_t>(faces.data()[i])] = true;
  const auto vertices = std::count(used.begin(), used.end(), true);
  return vertices - static_cast<std::int64_t>(edges.size()) + faces.rows();
}

}  // namespace spherematch
