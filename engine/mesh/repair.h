// From a mesh as uploaded to one closed, oriented, manifold surface of genus zero, or a precise refusal.
#pragma once

#include "engine/data/surface.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

/// Repairs as contract.md "Meshes" says; the result fulfils the invariants of Surface. A clean mesh of triangles comes back as it
/// is: same vertices, same faces, same order. Near-linear in the number of polygon corners. Thread-safe, deterministic.
///
/// RepairMode::fill, in this order: triangulates polygons over their own corners; drops faces with a repeated corner and
/// duplicate faces; glues faces along edges, deciding by geometry where more than two meet; welds coincident boundary edges
/// unless the mesh is a closed manifold as indexed; makes one vertex of each fan of glued corners (which splits non-manifold
/// vertices); keeps the largest component by area; turns faces to agree; closes boundary loops, without added vertices where
/// that makes no edge twice, else by a fan round one added vertex; removes triangles of zero area by collapsing or
/// flipping an edge where possible; turns the surface outward.
///
/// RepairMode::none changes nothing but triangulating polygons, and refuses a mesh that has any of these defects.
///
/// @throws EngineError, its elements in uploaded indices, at most 20 of each kind:
///   malformed_mesh           a face with a vertex that does not exist
///   degenerate               non-finite coordinates, zero area or volume, fewer than four usable vertices;
///                            none: repeated corners, duplicate faces, triangles of zero area
///   non_manifold             two edges with the same two vertices that splitting cannot tell apart;
///                            none: an edge of more than two faces, a vertex of more than one fan
///   inconsistent_orientation the surface is not orientable; none: neighbours disagree, or all faces point inward
///   not_closed               none: boundary edges
///   disconnected             none: several components, or a vertex without a face
///   wrong_genus              closed, but of positive genus; the message names it
[[nodiscard]] Surface repair(const PolygonMesh& upload, RepairMode mode);

}  // namespace spherematch
