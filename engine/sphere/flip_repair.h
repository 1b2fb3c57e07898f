// Keeps flipped triangles out of a spherical parametrisation.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/data/tri_mesh.h"

namespace spherematch {

/// Projects a parametrisation onto the set of those without thin or flipped faces, by position-based dynamics (Mueller et al. 2007).
/// Immutable; const members may be called from several threads.
class FlipRepair {
 public:
  /// Faces are treated in the order of their areas on the surface, so that the result does not depend on how they are numbered.
  explicit FlipRepair(const TriMesh& surface) : FlipRepair(surface.vertices, surface.faces) {}
  FlipRepair(const Points& surface_vertices, const Triangles& faces);

  /// Widens thin and flipped faces, first to a comfortable height and, where that does not end, to a smaller one.
  /// Returns whether no face is flipped any more.
  [[nodiscard]] bool repair(Points& sphere) const;

  [[nodiscard]] std::size_t bytes() const { return 4 * (static_cast<std::size_t>(faces_.size()) + start_.size() + face_.size()); }

 private:
  /// Each face whose height over its longest edge is below `thinness` times that edge gets, in turn, the smallest move of its
  /// corners that restores it, until none is left or `max_passes` are done. Vertices away from such faces stay.
  void widen_all(Points& sphere, double thinness, int max_passes) const;
  [[nodiscard]] bool widen(Points& sphere, std::int32_t face, double thinness) const;

  Triangles faces_;                         ///< by growing area on the surface
  std::vector<std::int32_t> start_, face_;  ///< the faces around each vertex, compressed rows
};

}  // namespace spherematch
