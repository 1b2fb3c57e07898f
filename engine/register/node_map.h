// The registration of a pair as a map that is a bijection wherever that can be checked.
#pragma once

#include "engine/data/tri_mesh.h"
#include "engine/register/flow_side.h"
#include "engine/register/node_mesh.h"

namespace spherematch {

/// Nodes with a place on each of two prepared spheres, and what lies between them: a triangle of nodes on the source sphere goes to the one
/// on the target sphere, linearly up to the distance from the centre. Where no triangle is turned over on either sphere, and both have them
/// once round, that is a bijection, and each direction is the inverse of the other up to rounding. Refers to the mesh.
class NodeMap {
 public:
  /// Where the nodes, which lie on the sphere that the two sides were carried to, come from. Triangles that the flow turned over are
  /// turned back.
  NodeMap(const NodeMesh& mesh, const FlowSide& source, const FlowSide& target);

  [[nodiscard]] const NodeMesh& mesh() const { return *mesh_; }
  [[nodiscard]] const Points& source() const { return source_; }
  [[nodiscard]] const Points& target() const { return target_; }

  /// Other places on both spheres; unit vectors, one per node.
  void move_to(Points source, Points target) {
    source_ = std::move(source);
    target_ = std::move(target);
  }

  /// Takes on what was moved on a coarser mesh since that map was made, from the same sides as this one.
  void follow(const NodeMap& coarse);

  /// Images of points (P, 3) of one sphere on the other, on up to `threads` threads.
  [[nodiscard]] Points forward(const Points& points, int threads = 1) const;
  [[nodiscard]] Points backward(const Points& points, int threads = 1) const;

  /// Whether no triangle is turned over on either sphere and both are covered once, by exact predicates and the sum of solid angles.
  [[nodiscard]] bool bijective() const;

 private:
  void follow(const Points& coarse, Points& fine) const;

  const NodeMesh* mesh_;
  Points source_, target_;  ///< (nodes, 3) unit vectors
};

}  // namespace spherematch
