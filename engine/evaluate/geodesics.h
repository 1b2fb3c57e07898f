// Distances along a surface, for measuring maps.
#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "engine/data/tri_mesh.h"

namespace spherematch {

/// The edges of a triangle mesh, and for each pair of neighbouring faces the straight way between their opposite corners where it
/// crosses the shared edge once they are unfolded into a plane. Shortest paths in this graph are 2 to 3 percent longer than
/// geodesics on the surface. Immutable and thread-safe.
class GeodesicGraph {
 public:
  /// `mesh` is an oriented manifold, with or without boundary.
  explicit GeodesicGraph(const TriMesh& mesh);

  /// Lengths of the shortest paths from vertex `source` to each of `targets`, in their order; infinity where there is no path. The
  /// search (Dijkstra's) ends when it has reached all of them, so that near ones cost little.
  [[nodiscard]] std::vector<double> distances(std::int32_t source, std::span<const std::int32_t> targets) const;

 private:
  friend class GeodesicSearch;

  struct Step {
    std::int32_t to;
    double length;
  };

  static void add(std::vector<std::vector<Step>>& steps, std::int32_t a, std::int32_t b, double length);

  std::vector<std::int32_t> offsets_;  ///< steps from vertex v are steps_[offsets_[v]] ... steps_[offsets_[v + 1] - 1]
  std::vector<Step> steps_;
};

/// Many searches in one graph, which must outlive this: what a search costs depends on how far it goes, not on the size of the mesh.
/// Used by one thread.
class GeodesicSearch {
 public:
  explicit GeodesicSearch(const GeodesicGraph& graph);

  /// A vertex where a path may begin, and the length that it then has already.
  struct Start {
    std::int32_t vertex;
    double length;
  };

  /// Lengths of the shortest paths from any of `starts` to each of `targets`, in their order; infinity where there is no path.
  [[nodiscard]] std::vector<double> distances(std::span<const Start> starts, std::span<const std::int32_t> targets);

 private:
  using Reached = std::pair<double, std::int32_t>;
  using Queue = std::priority_queue<Reached, std::vector<Reached>, std::greater<>>;

  void reach(Queue& queue, std::int32_t vertex, double length);

  const GeodesicGraph& graph_;
  std::vector<double> distance_;       ///< per vertex; infinity outside of a search
  std::vector<bool> wanted_;           ///< per vertex; false outside of a search
  std::vector<std::int32_t> touched_;  ///< vertices whose distance is to be forgotten
};

}  // namespace spherematch
