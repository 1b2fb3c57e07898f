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

  [[nodiscard]] std::size_t bytes() const {
    return 4 * (static_cast<std::size_t>(faces_.size()) + rank_.size() + start_.size() + face_.size());
  }

 private:
  /// Whether the face's height over its longest edge may be less than `thinness` times that edge; never false where it is, or where the
  /// face is flipped.
  [[nodiscard]] bool may_be_thin(const Points& sphere, std::int32_t face, double thinness) const;

  /// Each face of `active` whose height over its longest edge is below `thinness` times that edge gets, in turn, the smallest move of
  /// its corners that restores it, then each face round a moved corner, until none is left or `max_passes` are done. `touched` gains
  /// the faces with a moved corner.
  void widen_all(Points& sphere, std::vector<std::int32_t> active, double thinness, int max_passes, std::vector<char>& touched) const;
  [[nodiscard]] bool widen(Points& sphere, std::int32_t face, double thinness) const;
  [[nodiscard]] Eigen::Vector3d corner(const Points& sphere, std::int32_t face, int k) const { return sphere.row(faces_(face, k)); }

  Triangles faces_;
  std::vector<std::int32_t> rank_;          ///< of each face among all by growing area on the surface
  std::vector<std::int32_t> start_, face_;  ///< the faces around each vertex by rank, compressed rows
};

}  // namespace spherematch
