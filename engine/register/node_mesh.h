// Nodes joined to triangles, by which a map between two spheres is represented and the elastic flow computes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/data/tri_mesh.h"
#include "engine/register/block_matrix.h"
#include "engine/sphere/flip_repair.h"

namespace spherematch {

/// (P, C): C values at each of P points. There are many: in single precision.
using PointValues = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Two orthonormal tangent vectors of the sphere at a point, the columns: what components of a vector there refer to.
using TangentFrame = Eigen::Matrix<double, 3, 2>;
[[nodiscard]] TangentFrame tangent_frame(const Eigen::Vector3d& p);

/// An icosphere with what is the same for all pairs. Immutable, thread-safe.
class NodeMesh {
 public:
  explicit NodeMesh(int subdivisions);

  [[nodiscard]] Eigen::Index count() const { return mesh_.vertices.rows(); }
  [[nodiscard]] const Points& nodes() const { return mesh_.vertices; }
  [[nodiscard]] const Triangles& faces() const { return mesh_.faces; }
  /// A third of the area of the triangles round each node.
  [[nodiscard]] const Eigen::VectorXd& areas() const { return areas_; }
  /// Keeps these triangles from being turned over, wherever on a sphere the nodes are.
  [[nodiscard]] const FlipRepair& repair() const { return repair_; }
  /// The two nodes of the next coarser icosphere that a node is in the middle of; twice itself where it is one of these.
  [[nodiscard]] const std::array<std::int32_t, 2>& parents(Eigen::Index node) const { return parents_[static_cast<std::size_t>(node)]; }

  /// Derivatives at nodes `first` to `last` - 1, at `places` on a sphere, of functions with `values` at all nodes: means over the triangles
  /// round each. Writes rows of `result`, (nodes, 2 C): C derivatives along the first vector of the node's frame, then C along the second.
  void differentiate(const PointValues& values, const Points& places, const std::vector<TangentFrame>& frames, Eigen::Index first,
                     Eigen::Index last, PointValues& result) const;

  /// Of a matrix over the components of vectors at the nodes, with a block for each two nodes of a triangle.
  [[nodiscard]] const BlockPattern& pattern() const { return pattern_; }
  /// The slots of a face's nodes: that of corners i and j is the entry 3 i + j.
  using FaceSlots = std::array<std::int32_t, 9>;
  [[nodiscard]] const FaceSlots& face_slots(Eigen::Index face) const { return face_slots_[static_cast<std::size_t>(face)]; }
  /// The slot of a node on the diagonal.
  [[nodiscard]] std::int32_t node_slot(Eigen::Index node) const { return node_slots_[static_cast<std::size_t>(node)]; }

 private:
  void find_parents(int subdivisions);
  void find_faces();
  void make_pattern();

  TriMesh mesh_;
  FlipRepair repair_;
  Eigen::VectorXd areas_;
  std::vector<std::array<std::int32_t, 2>> parents_;
  std::vector<std::int32_t> start_, face_;  ///< the faces round each node, compressed rows
  BlockPattern pattern_;
  std::vector<FaceSlots> face_slots_;
  std::vector<std::int32_t> node_slots_;
};

}  // namespace spherematch
