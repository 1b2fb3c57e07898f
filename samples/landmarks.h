// Points of the rest surface that every mesh of it has as vertices.
#pragma once

#include <vector>

#include "samples/flesh.h"
#include "samples/surface_mesh.h"

namespace spherematch::samples {

struct Ball {
  Vec3 centre;
  double radius;
};

/// Whether p is in one of the balls.
[[nodiscard]] bool is_in(const std::vector<Ball>& balls, const Vec3& p);

struct Landmarks {
  std::vector<Vec3> points;
  std::vector<int> mirror;  ///< points[mirror[i]] == mirrored(points[i]), bit for bit
};

/// At least `count` points spread evenly by farthest point sampling along the edges of `mesh`, a mesh of the surface. They come in pairs of
/// mirror images, or are in the middle plane. No point and no mirror image of one is in a ball of `avoided`.
[[nodiscard]] Landmarks spread_landmarks(const Flesh& flesh, const Mesh& mesh, std::size_t count, const std::vector<Ball>& avoided);

}  // namespace spherematch::samples
