// What registration reads of one shape of a pair.
#pragma once

#include <Eigen/Core>

#include "engine/data/parameters.h"
#include "engine/data/preprocessed_shape.h"
#include "engine/data/tri_mesh.h"
#include "engine/sphere/grid_samples.h"

namespace spherematch {

/// A shape as it was prepared, or its mirror image. Immutable.
struct Side {
  bool mirrored;
  Grid rotation;                   ///< the stored signal that rotations are aligned by
  GridSamples flow;                ///< one channel per flow time
  GridSamples selection;           ///< engine/register/selection.h
  Points sphere;                   ///< (V, 3), of the vertices of the surface's working mesh
  Triangles faces;                 ///< (F, 3), oriented like `sphere`
  Eigen::MatrixXd vertex_signals;  ///< (V, flow times), where the flow moves meshes; else empty

  /// @throws EngineError(invalid_parameter) when a time is none of those at which the shape's signals are stored
  Side(const PreprocessedShape& shape, const MatchParameters& parameters, bool as_mirror_image);
};

}  // namespace spherematch
