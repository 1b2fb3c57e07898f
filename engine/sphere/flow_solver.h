// One implicit step of the conformalised mean curvature flow, and what the stages before and after it need of a surface's areas.
#pragma once

#include <Eigen/SparseCholesky>

#include "engine/data/tri_mesh.h"
#include "engine/mesh/intrinsic_delaunay.h"
#include "engine/mesh/laplacian.h"

namespace spherematch {

/// Moves the area-weighted centroid to the origin and scales the area to one.
void normalize(Points& x, const Triangles& faces);

/// The flow of one surface. Refers to its arguments for as long as it lives.
class FlowSolver {
 public:
  /// `x` (V, 3) is what flows; `intrinsic` is the triangulation whose stiffness is frozen.
  FlowSolver(Points& x, const Triangles& faces, const IntrinsicMesh& intrinsic);

  /// `conductivity` (V) scales stiffness and mass around each vertex; `step_size` is the flow's time step.
  void set_stiffness(const Eigen::VectorXd& conductivity, double step_size);

  /// One step; x is normalised after it. False where the system is singular or the flow diverges.
  [[nodiscard]] bool step();

  /// Root of the mean square over the sphere's area by which the last step moved points, which tends to zero as the flow settles.
  [[nodiscard]] double last_move() const { return last_move_; }

 private:
  Points& x_;
  const Triangles& faces_;
  const IntrinsicMesh& intrinsic_;
  Eigen::VectorXd areas_;
  SparseMatrix pattern_;
  ElementAssembler flowing_, frozen_;
  SparseMatrix stiffness_, mass_, system_;
  Eigen::VectorXd density_;  ///< per face of the mesh; scales the mass as the conductivity does the stiffness
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower> solver_;
  double last_move_ = 0;
};

}  // namespace spherematch
