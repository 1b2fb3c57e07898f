// Point signatures of the eigenbasis.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace spherematch {

/// Heat kernel signatures (Sun, Ovsjanikov, Guibas 2009): sum_i exp(-lambda_i t) phi_i^2, one column per time, (V, T).
/// `values` (k) and `vectors` (V, k) belong to the surface scaled to unit area.
[[nodiscard]] Eigen::MatrixXd heat_kernel_signatures(const Eigen::VectorXd& values, const Eigen::MatrixXf& vectors,
                                                     const std::vector<double>& times);

/// Wave kernel signatures (Aubry, Schlickewei, Cremers 2011) at `count` logarithmically spaced energies between the first positive
/// and the largest eigenvalue, (V, count).
[[nodiscard]] Eigen::MatrixXd wave_kernel_signatures(const Eigen::VectorXd& values, const Eigen::MatrixXf& vectors, int count);

}  // namespace spherematch
