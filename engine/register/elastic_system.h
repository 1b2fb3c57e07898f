// The equations of one step of the elastic flow (engine/register/elastic_flow.h).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/register/block_matrix.h"
#include "engine/register/node_mesh.h"
#include "engine/register/strain.h"

namespace spherematch {

/// For differences that count by their square, however large.
inline constexpr double no_yield = 1e9;

/// The shape whose nodes move in a step: its values there, the first three of which are the position on the surface, and how these change.
/// Refers to the values.
struct MovingSide {
  MovingSide(const PointValues& at_nodes, const Points& places, const NodeMesh& mesh, int threads);

  [[nodiscard]] MovingTriangle triangle(const Triangles& faces, Eigen::Index face) const;

  const PointValues& values;
  std::vector<TangentFrame> frames;  ///< of the nodes
  PointValues derivatives;           ///< (nodes, 2 C): of the C values along the first vector of the frame, then along the second
};

/// A quadratic model, over tangent vectors at the nodes, of how the energy changes when they move. Refers to the mesh.
class ElasticSystem {
 public:
  explicit ElasticSystem(const NodeMesh& mesh);

  /// Of the map from the resting shape, whose values at the nodes are given, to the other: `area` weighs changes of area, strains above
  /// `yield` count less than by their square.
  void add_strain(const PointValues& resting, const MovingSide& moving, double area, double yield, int threads);

  /// Surface area round each node, the mean of both shapes: known once the strain is.
  [[nodiscard]] const Eigen::VectorXd& masses() const { return masses_; }

  /// Squares of differences (nodes, m), of the moving shape's values `first` to `first` + m - 1 less what they are to be, with the weights
  /// of these values. Nodes where they are larger than their mean over the surface by more than the factor `yield` count less and less:
  /// there the shapes differ, or the map is wrong. Needs the masses.
  void add_differences(const MovingSide& moving, Eigen::Index first, const PointValues& differences, const Eigen::RowVectorXf& weights,
                       double yield, int threads);

  /// A move that the nodes at `places` round a point are to make: many of them, for one alone would turn triangles over.
  void add_wish(const Points& places, const Eigen::Vector3d& point, const Eigen::Vector3d& wanted, const std::vector<TangentFrame>& frames);

  /// The step, two components per node.
  [[nodiscard]] Eigen::VectorXd solve() const;

  /// Mean over both surfaces of the squares of the strains that were added, weighted.
  [[nodiscard]] double strain() const { return area_ > 0 ? strain_ / area_ : 0; }

 private:
  const NodeMesh& mesh_;
  BlockMatrix matrix_;
  Eigen::VectorXd right_;
  Eigen::VectorXd masses_;
  double strain_ = 0, area_ = 0;
};

}  // namespace spherematch
