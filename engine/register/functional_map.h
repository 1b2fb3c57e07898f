// Functional maps (Ovsjanikov et al. 2012): a map between two shapes as the matrix that takes functions on one to functions on the other.
#pragma once

#include <Eigen/Core>

#include "engine/register/node_mesh.h"

namespace spherematch {

/// What a functional map says of nodes that stand for points of both shapes.
struct SpectralDifferences {
  PointValues values;            ///< (nodes, k): functions of the moving shape less what the functional map makes of the resting shape's
  Eigen::RowVectorXf explained;  ///< (k): the share of each function's square that the functional map explains, 0 to 1
};

/// Of the first eigenfunctions of both shapes, (nodes, k) each, constants left out. The functional map is that of least squares over the
/// nodes, whose `masses` weigh them. It is small where the map from node to node is rough: so the differences are what a smoother map would
/// not have, and where shapes are nearly isometric that map is the better one (as in ZoomOut, Melzi et al. 2019).
[[nodiscard]] SpectralDifferences spectral_differences(const Eigen::Ref<const PointValues>& resting,
                                                       const Eigen::Ref<const PointValues>& moving, const Eigen::VectorXd& masses,
                                                       int threads);

}  // namespace spherematch
