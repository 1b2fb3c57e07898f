// Mean curvature of a surface at a chosen scale, from its eigenbasis.
#pragma once

#include <Eigen/Core>

#include "engine/data/tri_mesh.h"

namespace spherematch {

/// Name of the signal that smoothed_mean_curvature() is stored as.
inline constexpr const char* curvature_signal_name = "mean_curvature";

/// Signed mean curvature at the vertices of a mesh of unit area after heat flow of its coordinates by `time`, positive where it bulges
/// outward: -(Laplacian of the coordinates) along the normals, divided by its root mean square over the surface, (V). What no function of
/// the metric alone can tell, chest from back and palm from the back of a hand, it tells. `values` (k) and `vectors` (V, k) are the
/// eigenbasis; modes beyond it count for nothing, so `time` should be some multiples of the inverse of the largest eigenvalue.
[[nodiscard]] Eigen::VectorXd smoothed_mean_curvature(const TriMesh& mesh, const Eigen::VectorXd& values, const Eigen::MatrixXf& vectors,
                                                      double time);

}  // namespace spherematch
