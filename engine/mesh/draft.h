// The mesh under repair: triangles of uploaded vertices, glued along half-edges. Internal to engine/mesh.
//
// Gluing, not vertex indices, says what the surface is: a vertex of the repaired surface is a class of triangle corners that glued
// edges identify. Non-manifold vertices therefore come apart and welded ones together without further ado.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/data/error.h"
#include "engine/data/surface.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

/// Half-edge h belongs to face h / 3 and runs from its corner h % 3 to the next.
using HalfEdge = std::int32_t;
constexpr HalfEdge no_half_edge = -1;

[[nodiscard]] constexpr HalfEdge next_in_face(HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; }

struct Draft {
  explicit Draft(const PolygonMesh& mesh) : upload(&mesh) {}

  const PolygonMesh* upload;  ///< must outlive the draft

  // Per corner, 3 per face; a half-edge and the corner that it starts at have the same number.
  std::vector<std::int32_t> corner;  ///< uploaded vertex, -1 for an added one
  std::vector<HalfEdge> mate;        ///< the half-edge glued to this one, or no_half_edge
  std::vector<char> same_way;        ///< 1 when the mate runs the same way, so one of the two faces must be turned
  std::vector<char> welded;          ///< 1 when glued because the ends coincide, not because they are the same vertices
  std::vector<std::int32_t> vertex;  ///< class of corners; set by number_vertices()

  // Per face.
  std::vector<std::int32_t> polygon;  ///< uploaded face that it came from, -1 for a patch
  std::vector<char> turned;           ///< 1 when its orientation is not the uploaded one

  std::vector<Eigen::Vector3d> position;  ///< per class; set by number_vertices()
  RepairReport report;

  [[nodiscard]] std::int32_t face_count() const { return static_cast<std::int32_t>(polygon.size()); }
  [[nodiscard]] HalfEdge half_edge_count() const { return static_cast<HalfEdge>(corner.size()); }
  [[nodiscard]] std::int32_t start(HalfEdge h) const { return corner[static_cast<std::size_t>(h)]; }
  [[nodiscard]] std::int32_t end(HalfEdge h) const { return start(next_in_face(h)); }
  [[nodiscard]] HalfEdge mate_of(HalfEdge h) const { return mate[static_cast<std::size_t>(h)]; }
  [[nodiscard]] std::int32_t vertex_of(HalfEdge h) const { return vertex[static_cast<std::size_t>(h)]; }
  [[nodiscard]] Eigen::Vector3d uploaded_position(HalfEdge h) const { return upload->vertices.row(start(h)).transpose(); }
  [[nodiscard]] const Eigen::Vector3d& position_of(HalfEdge h) const { return position[static_cast<std::size_t>(vertex_of(h))]; }

  /// Appends an unglued face and returns its first half-edge.
  HalfEdge add_face(const std::array<std::int32_t, 3>& corners, std::int32_t from_polygon);
  void glue(HalfEdge a, HalfEdge b, bool runs_same_way, bool by_weld);
  void unglue(HalfEdge h);
  /// Turns a face round: swaps its corners 1 and 2 and everything that hangs on them.
  void turn_face(std::int32_t face);
  /// Keeps the faces with a nonzero entry, in their order. Mates of removed faces become boundary.
  void keep_faces(const std::vector<char>& keep);
};

/// Collects the offending elements of one refusal, at most 20 of each kind.
class Offenders {
 public:
  void add_vertex(std::int32_t vertex);
  void add_face(std::int32_t face);
  void add_edge(std::int32_t a, std::int32_t b);
  [[nodiscard]] const OffendingElements& elements() const { return elements_; }

 private:
  OffendingElements elements_;
};

/// Makes the classes of corners: sets vertex, position and the counts of welded and split vertices. Classes are numbered by
/// their lowest uploaded vertex, then by their lowest corner, so a manifold upload keeps its own numbers (less unused ones).
void number_vertices(Draft& draft);

}  // namespace spherematch
