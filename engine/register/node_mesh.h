// Nodes on the sphere where two shapes are registered, joined to triangles: what the elastic flow computes on.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/data/tri_mesh.h"
#include "engine/register/point_location.h"
#include "engine/sphere/harmonics.h"

namespace spherematch {

/// An icosphere with what is the same for all pairs. Immutable, thread-safe.
class NodeMesh {
 public:
  /// (nodes, C) values of C functions.
  using Values = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// `grid_resolution`: of the grids that fields are made on.
  NodeMesh(int subdivisions, int grid_resolution);
  NodeMesh(const NodeMesh&) = delete;
  NodeMesh& operator=(const NodeMesh&) = delete;

  [[nodiscard]] Eigen::Index count() const { return mesh_.vertices.rows(); }
  [[nodiscard]] const Points& nodes() const { return mesh_.vertices; }
  [[nodiscard]] const Triangles& faces() const { return mesh_.faces; }
  [[nodiscard]] const PointLocation& location() const { return location_; }
  /// Two orthonormal tangent vectors, the columns: what components of vectors at a node refer to.
  [[nodiscard]] const Eigen::Matrix<double, 3, 2>& tangents(Eigen::Index node) const { return tangents_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] int grid_resolution() const { return grid_resolution_; }
  /// A third of the area of the triangles round a node.
  [[nodiscard]] double area(Eigen::Index node) const { return areas_[node]; }

  /// Derivatives along both tangent directions of each node, (nodes, 2 C): C along the first, then C along the second.
  [[nodiscard]] Values derivatives(const Values& values) const;

  /// The field with tangent vector u[2 i], u[2 i + 1] at node i, linear in between.
  [[nodiscard]] TangentGrid field(const Eigen::VectorXd& u) const;

  /// A symmetric matrix over the components of tangent vectors, with an entry for each two nodes of a triangle; the lower half.
  [[nodiscard]] const Eigen::SparseMatrix<double>& pattern() const { return pattern_; }
  /// Where the pattern's values have the lower half of the 6 x 6 matrix of a face, row by row; and of the 2 x 2 matrix of a node.
  using FaceSlots = std::array<std::int32_t, 21>;
  using NodeSlots = std::array<std::int32_t, 3>;
  [[nodiscard]] const FaceSlots& face_slots(Eigen::Index face) const { return face_slots_[static_cast<std::size_t>(face)]; }
  [[nodiscard]] const NodeSlots& node_slots(Eigen::Index node) const { return node_slots_[static_cast<std::size_t>(node)]; }

 private:
  void make_pattern();

  TriMesh mesh_;
  PointLocation location_;
  int grid_resolution_;
  std::vector<Eigen::Matrix<double, 3, 2>> tangents_;  ///< of each node
  std::vector<Eigen::Matrix3d> gradients_;             ///< of each face: column k times its area is what a value at corner k adds
  Eigen::VectorXd areas_;
  Eigen::SparseMatrix<double> grid_field_;  ///< (2 N^2, 2 nodes): components on the grid of fields given at the nodes
  Eigen::SparseMatrix<double> pattern_;
  std::vector<FaceSlots> face_slots_;
  std::vector<NodeSlots> node_slots_;
};

}  // namespace spherematch
