#include "engine/mesh/fill_holes.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <unordered_set>

#include "engine/mesh/polygon_triangulation.h"

namespace spherematch {

namespace {

constexpr std::int64_t most_work = 50'000'000;

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }
std::uint64_t key(std::int32_t a, std::int32_t b) { return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint64_t>(b); }

class HoleFiller {
 public:
  explicit HoleFiller(Draft& draft) : draft_(draft), surface_half_edges_(draft.half_edge_count()) { collect_boundary_edges(); }

  void fill_all() {
    for (HalfEdge h = 0; h < surface_half_edges_; ++h)
      if (draft_.mate_of(h) == no_half_edge) fill(loop_from(h));
  }

 private:
  /// Edges between two boundary vertices: those that a chord of a patch could repeat. Only looked up, never walked through.
  void collect_boundary_edges() {
    std::vector<char> on_boundary(draft_.position.size(), 0);
    for (HalfEdge h = 0; h < surface_half_edges_; ++h)
      if (draft_.mate_of(h) == no_half_edge) on_boundary[at(draft_.vertex_of(h))] = 1;
    for (HalfEdge h = 0; h < surface_half_edges_; ++h) {
      const std::int32_t from = draft_.vertex_of(h);
      const std::int32_t to = draft_.vertex_of(next_in_face(h));
      if (on_boundary[at(from)] != 0 && on_boundary[at(to)] != 0) edges_.insert(key(std::min(from, to), std::max(from, to)));
    }
  }

  /// The boundary half-edges from h on, each starting where the one before ends.
  [[nodiscard]] std::vector<HalfEdge> loop_from(HalfEdge h) const {
    std::vector<HalfEdge> loop{h};
    for (HalfEdge next = boundary_after(h); next != h; next = boundary_after(next)) loop.push_back(next);
    return loop;
  }

  [[nodiscard]] HalfEdge boundary_after(HalfEdge h) const {
    HalfEdge next = next_in_face(h);
    while (draft_.mate_of(next) != no_half_edge) next = next_in_face(draft_.mate_of(next));
    return next;
  }

  void fill(const std::vector<HalfEdge>& loop) {
    ++draft_.report.filled_loops;
    if (loop.size() == 2) {
      draft_.glue(loop[0], loop[1], false, false);
      return;
    }
    // A patch continues the surface, so it runs round the loop the other way.
    std::vector<HalfEdge> polygon(loop.rbegin(), loop.rend());
    if (const auto triangles = triangulate(polygon))
      add_patch(polygon, *triangles);
    else
      add_fan(polygon);
  }

  std::optional<PolygonTriangles> triangulate(const std::vector<HalfEdge>& polygon) {
    const auto n = static_cast<std::int64_t>(polygon.size());
    if (n > most_triangulated_corners || work_ + triangulation_work(n) > most_work) return std::nullopt;
    work_ += triangulation_work(n);
    std::vector<Eigen::Vector3d> points;
    points.reserve(polygon.size());
    for (const HalfEdge h : polygon) points.push_back(draft_.position_of(h));
    return triangulate_polygon(points, [&](std::int32_t i, std::int32_t j) {
      const auto [low, high] = std::minmax({draft_.vertex_of(polygon[at(i)]), draft_.vertex_of(polygon[at(j)])});
      return low != high && !edges_.contains(key(low, high));
    });
  }

  void add_patch(const std::vector<HalfEdge>& polygon, const PolygonTriangles& triangles) {
    open_.clear();
    for (const HalfEdge h : polygon) open_[key(draft_.vertex_of(h), draft_.vertex_of(next_in_face(h)))] = h;
    for (const auto& triangle : triangles) {
      add_face({corner_of(polygon[at(triangle[0])]), corner_of(polygon[at(triangle[1])]), corner_of(polygon[at(triangle[2])])});
    }
  }

  void add_fan(const std::vector<HalfEdge>& polygon) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const HalfEdge h : polygon) centre += draft_.position_of(h) / static_cast<double>(polygon.size());
    const Corner hub{static_cast<std::int32_t>(draft_.position.size()), -1};
    draft_.position.push_back(centre);
    ++draft_.report.added_vertices;
    open_.clear();
    for (const HalfEdge h : polygon) open_[key(draft_.vertex_of(h), draft_.vertex_of(next_in_face(h)))] = h;
    for (std::size_t i = 0; i < polygon.size(); ++i) add_face({corner_of(polygon[i]), corner_of(polygon[(i + 1) % polygon.size()]), hub});
  }

  struct Corner {
    std::int32_t vertex;
    std::int32_t uploaded;
  };

  [[nodiscard]] Corner corner_of(HalfEdge h) const { return {draft_.vertex_of(h), draft_.start(h)}; }

  /// Glues the new face to the half-edges of the loop and of the patch that run against it.
  void add_face(const std::array<Corner, 3>& corners) {
    const HalfEdge first = draft_.add_face({corners[0].uploaded, corners[1].uploaded, corners[2].uploaded}, -1);
    ++draft_.report.added_faces;
    for (std::int32_t k = 0; k < 3; ++k) {
      const std::int32_t from = corners[at(k)].vertex;
      const std::int32_t to = corners[at((k + 1) % 3)].vertex;
      draft_.vertex[at(first + k)] = from;
      edges_.insert(key(std::min(from, to), std::max(from, to)));
      const auto opposite = open_.find(key(to, from));
      if (opposite == open_.end())
        open_[key(from, to)] = first + k;
      else
        draft_.glue(first + k, opposite->second, false, false);
    }
  }

  Draft& draft_;
  const HalfEdge surface_half_edges_;
  std::unordered_set<std::uint64_t> edges_;
  std::unordered_map<std::uint64_t, HalfEdge> open_;  ///< half-edges of the current patch and its loop, by their vertices
  std::int64_t work_ = 0;
};

}  // namespace

void fill_holes(Draft& draft) { HoleFiller(draft).fill_all(); }

}  // namespace spherematch
