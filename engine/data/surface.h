// An uploaded mesh after repair: the closed genus-zero surface that the method works on, and how it speaks of the upload.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/data/tri_mesh.h"

namespace spherematch {

enum class RepairMode { none, fill };

/// How an upload becomes a surface.
struct ReadOptions {
  static constexpr std::int32_t least_simplify = 500;

  RepairMode repair = RepairMode::fill;
  std::int32_t simplify = 0;  ///< prepare a copy of this many vertices where the surface has more; 0 for never

  bool operator==(const ReadOptions&) const = default;
  /// @throws EngineError(invalid_parameter)
  void validate() const;
};

/// What repair did. All zero when the upload was already one closed, oriented, manifold sphere.
struct RepairReport {
  std::int32_t filled_loops = 0;        ///< boundary loops closed
  std::int32_t added_vertices = 0;      ///< vertices of the surface that the upload does not have
  std::int32_t added_faces = 0;         ///< triangles over filled loops
  std::int32_t dropped_vertices = 0;    ///< uploaded vertices without a place on the surface
  std::int32_t welded_vertices = 0;     ///< uploaded vertices merged into a coincident one
  std::int32_t split_vertices = 0;      ///< copies made of non-manifold vertices
  std::int32_t flipped_faces = 0;       ///< faces turned to agree with their neighbours or to face outward
  std::int32_t removed_faces = 0;       ///< degenerate or duplicate faces, and faces of smaller components
  std::int32_t dropped_components = 0;  ///< components other than the largest by area

  bool operator==(const RepairReport&) const = default;
};

/// A point on a triangle mesh.
struct SurfacePoint {
  std::int32_t face = -1;
  std::array<double, 3> weights{};  ///< barycentric in the face's corners, non-negative, sum 1
};

/// A coarser mesh that takes the place of a surface's own; the invariants of Surface hold for it too.
struct DecimatedMesh {
  TriMesh mesh;
  std::vector<SurfacePoint> places;  ///< of each vertex of Surface::mesh: a point of this mesh
  double seconds = 0;                ///< wall-clock time that it took
};

/// Invariants: `mesh` is closed, connected, manifold, consistently oriented with positive signed volume and of Euler
/// characteristic 2; every coordinate is finite; the total area is positive. Coordinates are those of the upload.
struct Surface {
  TriMesh mesh;                              ///< V vertices, F faces
  Triangles uploaded_corners;                ///< (F, 3): each face's corners as uploaded vertices, -1 at an added vertex and
                                             ///< at all three where an edge of a zero-area triangle was flipped
  std::vector<std::int32_t> surface_vertex;  ///< per uploaded vertex: a vertex of `mesh` at its place, or -1 when dropped
  std::int32_t uploaded_faces = 0;           ///< polygons in the upload
  RepairReport report;
  std::optional<DecimatedMesh> decimated;  ///< where the method shall work on fewer vertices (engine/mesh/decimate.h)

  /// What parametrisation, eigenbasis and registration work on.
  [[nodiscard]] const TriMesh& working_mesh() const { return decimated ? decimated->mesh : mesh; }
  [[nodiscard]] std::int32_t uploaded_vertices() const { return static_cast<std::int32_t>(surface_vertex.size()); }
};

}  // namespace spherematch
