// What registration reads of one shape of a pair.
#pragma once

#include <Eigen/Core>

#include "engine/data/parameters.h"
#include "engine/data/preprocessed_shape.h"
#include "engine/data/tri_mesh.h"
#include "engine/sphere/flip_repair.h"

namespace spherematch {

/// What does not change when the shape is mirrored. One row per vertex.
struct SideSignals {
  Eigen::MatrixXd flow;       ///< one column per flow time
  Eigen::MatrixXd selection;  ///< engine/register/selection.h
  Eigen::VectorXd weights;    ///< vertex areas, sum 1

  SideSignals(const PreprocessedShape& shape, const MatchParameters& parameters);
};

/// A shape as it was prepared, or its mirror image. Immutable; refers to `signals`, which must outlive it.
struct Side {
  bool mirrored;
  const SideSignals& signals;
  TriMesh mesh;   ///< consistently oriented like `sphere`; the vertices are those of the surface, mirrored or not
  Points sphere;  ///< (V, 3)
  FlipRepair repair;

  Side(const PreprocessedShape& shape, const SideSignals& shape_signals, bool as_mirror_image);
};

/// The stored signal that rotations are aligned by, of the shape or of its mirror image.
/// @throws EngineError(invalid_parameter) when no signal is stored at parameters.rotation_time
[[nodiscard]] Eigen::MatrixXf rotation_grid(const PreprocessedShape& shape, const MatchParameters& parameters, bool mirrored);

}  // namespace spherematch
