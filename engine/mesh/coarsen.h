// Coarse copies of a closed surface for multilevel methods: fast, and made of the surface's own vertices.
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/data/progress.h"
#include "engine/data/surface.h"

namespace spherematch {

struct CoarseMesh {
  TriMesh mesh;                           ///< closed, manifold, of genus zero, oriented like the fine mesh
  std::vector<std::int32_t> fine_vertex;  ///< of each coarse vertex: the fine vertex that it is
  std::vector<SurfacePoint> places;       ///< of each fine vertex: a point of the coarse mesh; a kept vertex is at its own corner
};

/// Removes vertices, each by drawing the faces round it to one of its neighbours, in rounds that spread over the surface: shortest
/// edges first, best triangles among the neighbours, no triangle turned over, no edge twice. Triangles come out of even size and
/// shape. The place of a removed vertex is the nearest point found on the coarse mesh by walking from the vertex that it went into, and
/// where there is a choice on a face that faces its own way, so that sheets which touch stay apart.
///
/// Nothing where no more than `vertices` (at least 4) are there, or where so many cannot be removed: at vertices of very many faces, or
/// where triangles would have to turn over. `fine` is closed, manifold, of genus zero and of about unit size; triangles without area are
/// allowed. Linear in the number of vertices. Thread-safe, deterministic.
/// @throws EngineError(cancelled)
[[nodiscard]] std::optional<CoarseMesh> coarsen(const TriMesh& fine, std::int32_t vertices, const Progress& progress = {});

/// (V, Vc) with the places' weights: takes values at coarse vertices to values at fine ones. At most three entries a row.
[[nodiscard]] Eigen::SparseMatrix<double, Eigen::RowMajor> interpolation(const CoarseMesh& coarse);

}  // namespace spherematch
