// One shape of a pair on its way to the other: its signals on the sphere, carried along by a growing warp.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "engine/data/tri_mesh.h"
#include "engine/register/match_shape.h"
#include "engine/register/warp.h"
#include "engine/sphere/grid_samples.h"
#include "engine/sphere/harmonics.h"

namespace spherematch {

/// Used by one thread at a time.
class FlowSide {
 public:
  virtual ~FlowSide() = default;

  /// Carried along by all moves so far: the signals of the given channels, one after the other. Both transforms are of the wanted degree;
  /// `on_nodes` has the resolution that is followed.
  [[nodiscard]] virtual std::vector<Harmonics> signals(const std::vector<std::size_t>& channels, const HarmonicTransform& on_level,
                                                       const HarmonicTransform& on_nodes) const = 0;

  /// From now on the grid of this resolution counts.
  virtual void follow(int resolution) = 0;

  /// For each cell centre of a grid, row by row, the point of the prepared sphere that was carried there, (N * N, 3).
  [[nodiscard]] virtual Points origins(int resolution) const = 0;

  /// The same for any points, (P, 3) unit vectors.
  [[nodiscard]] virtual Points origins(const Points& points) const { return warp_.backward(points); }

  /// Appends a step to the warp.
  virtual void move(const std::shared_ptr<const TangentField>& field, double step) = 0;

  [[nodiscard]] const Warp& warp() const { return warp_; }

 protected:
  explicit FlowSide(const Eigen::Matrix3d& rotation) : warp_(rotation) {}

  Warp warp_;
};

/// Follows where the nodes of a grid come from, and reads there the signals of the prepared sphere. Its cost does not depend on the mesh.
class GridFlowSide : public FlowSide {
 public:
  /// The side's channels are the given ones of `samples`, which lie on the prepared sphere. Neither is owned.
  GridFlowSide(const GridSamples& samples, const std::vector<Eigen::Index>& channels, const Eigen::Matrix3d& rotation, int resolution);

  [[nodiscard]] std::vector<Harmonics> signals(const std::vector<std::size_t>& channels, const HarmonicTransform& on_level,
                                               const HarmonicTransform& on_nodes) const override;
  void follow(int resolution) override;
  [[nodiscard]] Points origins(int resolution) const override;
  [[nodiscard]] Points origins(const Points& points) const override;
  void move(const std::shared_ptr<const TangentField>& field, double step) override;

 private:
  const GridSamples& samples_;
  const std::vector<Eigen::Index>& channels_;
  int resolution_;
  Points origins_;  ///< of the nodes
};

/// A mesh on its prepared sphere, with a signal per channel at each vertex.
struct MeshSignals {
  MeshSignals(Points prepared_sphere, Triangles mesh_faces, Eigen::MatrixXd vertex_signals)
      : sphere(std::move(prepared_sphere)), faces(std::move(mesh_faces)), signals(std::move(vertex_signals)) {}
  /// The heat kernel signatures of the shape at the given times, then its selection signals.
  MeshSignals(const MatchShape& shape, const std::vector<double>& times);

  Points sphere;            ///< (V, 3)
  Triangles faces;          ///< (F, 3)
  Eigen::MatrixXd signals;  ///< (V, C)
};

/// Moves the vertices of the mesh and rasterises it anew for each call, as the paper does.
class MeshFlowSide : public FlowSide {
 public:
  MeshFlowSide(std::shared_ptr<const MeshSignals> mesh, const Eigen::Matrix3d& rotation);

  [[nodiscard]] std::vector<Harmonics> signals(const std::vector<std::size_t>& channels, const HarmonicTransform& on_level,
                                               const HarmonicTransform& on_nodes) const override;
  void follow(int resolution) override;
  [[nodiscard]] Points origins(int resolution) const override;
  void move(const std::shared_ptr<const TangentField>& field, double step) override;

 private:
  std::shared_ptr<const MeshSignals> mesh_;
  Points sphere_;
};

}  // namespace spherematch
