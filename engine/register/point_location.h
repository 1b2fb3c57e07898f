// Finds the spherical triangle that holds a point.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/data/tri_mesh.h"

namespace spherematch {

struct Location {
  std::int32_t face = -1;
  Eigen::Vector3d bary;  ///< weights of the face's corners, non-negative, sum 1: the point's ray meets the flat triangle there
};

/// A bounding volume hierarchy over the faces of a spherical triangulation. Keeps references to its inputs, which must outlive it.
/// Queries are thread-safe.
class PointLocation {
 public:
  PointLocation(const Points& sphere, const Triangles& faces);

  /// The face that contains the unit vector `p`, by the signs of its spherical areas. Of several (folds) or none (rounding) the one
  /// in which `p` is deepest inside, ties to the lowest index.
  [[nodiscard]] Location locate(const Eigen::Vector3d& p) const;

  [[nodiscard]] std::size_t bytes() const { return nodes_.size() * sizeof(Node) + order_.size() * sizeof(order_[0]); }

 private:
  struct Node {
    Eigen::Array3d low, high;
    std::int32_t first, count;  ///< a leaf's faces in order_; for an inner node count is 0 and first its right child
  };

  std::int32_t build(std::int32_t begin, std::int32_t end, const std::vector<Eigen::Array3d>& low, const std::vector<Eigen::Array3d>& high);
  [[nodiscard]] Eigen::Vector3d weights(std::int32_t face, const Eigen::Vector3d& p) const;

  const Points& sphere_;
  const Triangles& faces_;
  std::vector<Node> nodes_;
  std::vector<std::int32_t> order_;
};

}  // namespace spherematch
