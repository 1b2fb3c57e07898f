// Intrinsic Delaunay triangulation of a mesh's own metric (Bobenko & Springborn 2007), after mollification of degenerate
// triangles (Sharp & Crane 2020). Its cotangent weights are non-negative, so harmonic functions keep the maximum principle,
// and it is defined for meshes with zero-area triangles.
#pragma once

#include "engine/data/tri_mesh.h"

namespace spherematch {

/// A triangulation known by its edge lengths alone. It has the vertices, the face count and the intrinsic geometry of the mesh it
/// was made from; two vertices may share more than one edge.
struct IntrinsicMesh {
  Triangles faces;  ///< (F, 3)
  Points lengths;   ///< (F, 3): entry (f, k) is the length of the edge opposite corner k; triangle inequalities are strict
};

/// The mesh's own edges and lengths, mollified: every length grows by the one smallest amount that makes each triangle inequality
/// hold with a margin of `margin` mean edge lengths.
[[nodiscard]] IntrinsicMesh intrinsic_mesh(const TriMesh& mesh, double margin = 1e-5);

/// Flips edges until every one is locally Delaunay, but for edges whose flip would join a vertex to itself. `mesh` must be closed and
/// manifold. Deterministic.
void make_delaunay(IntrinsicMesh& mesh);

/// Areas of the faces from their lengths, (F).
[[nodiscard]] Eigen::VectorXd face_areas(const IntrinsicMesh& mesh);

}  // namespace spherematch
