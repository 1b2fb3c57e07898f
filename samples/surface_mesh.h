// A closed triangle mesh that can be changed edge by edge.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "samples/vec3.h"

namespace spherematch::samples {

using Triangle = std::array<int, 3>;

/// Vertices and counter-clockwise triangles seen from outside.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

/// Half-edge 3 f + i of face f leads from its corner i to corner i + 1. Every half-edge has a twin in the neighbouring face: the mesh is
/// closed and manifold, and every operation keeps it so. Removed vertices and faces stay as gaps until compact().
class SurfaceMesh {
 public:
  /// @throws std::invalid_argument when the mesh is not closed, oriented and manifold along its edges
  explicit SurfaceMesh(const Mesh& mesh);

  [[nodiscard]] int halfedge_count() const { return static_cast<int>(origin_.size()); }
  [[nodiscard]] int vertex_count() const { return static_cast<int>(position_.size()); }
  [[nodiscard]] bool halfedge_alive(int h) const { return origin_[at(h)] >= 0; }
  [[nodiscard]] bool vertex_alive(int v) const { return halfedge_of_[at(v)] >= 0; }

  [[nodiscard]] static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
  [[nodiscard]] static int previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
  [[nodiscard]] int twin(int h) const { return twin_[at(h)]; }
  [[nodiscard]] int origin(int h) const { return origin_[at(h)]; }
  [[nodiscard]] int target(int h) const { return origin_[at(next(h))]; }
  [[nodiscard]] int apex(int h) const { return origin_[at(previous(h))]; }

  [[nodiscard]] const Vec3& position(int v) const { return position_[at(v)]; }
  void move(int v, const Vec3& p) { position_[at(v)] = p; }
  /// The half-edges that leave v, in clockwise order.
  [[nodiscard]] std::vector<int> outgoing(int v) const;
  [[nodiscard]] int valence(int v) const { return static_cast<int>(outgoing(v).size()); }
  [[nodiscard]] double length(int h) const { return distance(position(origin(h)), position(target(h))); }
  /// Twice the area times the outward normal.
  [[nodiscard]] Vec3 area_vector(int h) const;

  /// Puts a vertex at p on the edge of h; returns it.
  int split(int h, const Vec3& p);
  /// Joins the two apexes instead of the ends of h; false, and nothing done, where they are joined already.
  bool flip(int h);
  /// Whether collapse(h) keeps the surface a manifold.
  [[nodiscard]] bool can_collapse(int h) const;
  /// Merges the origin of h into its target, which stays where it is.
  void collapse(int h);

  /// The mesh without gaps; new_index, when given, receives for each vertex its number there or -1.
  [[nodiscard]] Mesh compact(std::vector<int>* new_index = nullptr) const;

 private:
  [[nodiscard]] static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  void pair(int h, int g);
  void set_face(int h, int a, int b, int c);  // the three half-edges from h on
  int add_face();

  std::vector<Vec3> position_;
  std::vector<int> halfedge_of_;  // one that leaves the vertex, -1 for a removed vertex
  std::vector<int> origin_;       // -1 for a removed half-edge
  std::vector<int> twin_;
};

}  // namespace spherematch::samples
