// A closed triangle mesh that can lose vertices, in flat arrays. Internal to engine/mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/data/tri_mesh.h"

namespace spherematch {

/// Half-edge 3 f + k runs from corner k of face f to corner (k + 1) % 3; it is a spoke of the vertex that it leaves.
class HalfEdges {
 public:
  /// `faces` are those of a closed manifold, and every vertex has one. Linear time.
  HalfEdges(const Triangles& faces, Eigen::Index vertex_count);

  [[nodiscard]] std::int32_t valence(std::int32_t vertex) const { return valence_[index(vertex)]; }
  /// The vertex at the end of a half-edge.
  [[nodiscard]] std::int32_t head(std::int32_t half_edge) const { return origin_[index(next(half_edge))]; }

  /// Calls visit(spoke) for the half-edges that leave `vertex`, counter-clockwise seen from outside.
  template <typename Visit>
  void for_each_spoke(std::int32_t vertex, const Visit& visit) const {
    const std::int32_t first = spoke_[index(vertex)];
    std::int32_t spoke = first;
    do {
      visit(spoke);
      spoke = twin_[index(previous(spoke))];
    } while (spoke != first);
  }

  /// Calls visit(corners) for the faces that are left, in their order.
  template <typename Visit>
  void for_each_face(const Visit& visit) const {
    for (std::size_t h = 0; h < origin_.size(); h += 3)
      if (origin_[h] >= 0) visit(std::array{origin_[h], origin_[h + 1], origin_[h + 2]});
  }

  /// Draws the vertex that `spoke` leaves along it into its head: two faces go, the others round it stay. The caller has made sure that
  /// the two have no common neighbours but the corners of the two faces, and that those have more than three faces.
  void collapse(std::int32_t spoke);

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  static std::int32_t next(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::int32_t previous(std::int32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  void drop_face_at(std::int32_t half_edge);

  std::vector<std::int32_t> origin_;   ///< (3 F): the vertex that a half-edge leaves, -1 where the face is gone
  std::vector<std::int32_t> twin_;     ///< (3 F): the half-edge the other way
  std::vector<std::int32_t> spoke_;    ///< (V): some half-edge that leaves the vertex
  std::vector<std::int32_t> valence_;  ///< (V)
};

}  // namespace spherematch
