// Point signatures of the eigenbasis.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace spherematch {

/// Heat kernel signatures (Sun, Ovsjanikov, Guibas 2009): sum_i exp(-lambda_i t) phi_i^2, one column per time, (V, T).
/// `values` (k) and `vectors` (V, k) belong to the surface scaled to unit area.
[[nodiscard]] Eigen::MatrixXd heat_kernel_signatures(const Eigen::VectorXd& values, const Eigen::MatrixXf& vectors,
                                                     const std::vector<double>& times);

/// Wave kernel signatures (Aubry, Schlickewei, Cremers 2011) at `count` logarithmically spaced energies between the first positive
/// and the largest eigenvalue, (V, count).
[[nodiscard]] Eigen::MatrixXd wave_kernel_signatures(const Eigen::VectorXd& values, const Eigen::MatrixXf& vectors, int count);

/// Names of the first of the selection signals, logarithms of heat kernel signatures.
[[nodiscard]] std::vector<std::string> heat_detail_names();

/// Names of the columns of selection_signals().
[[nodiscard]] std::vector<std::string> selection_signal_names();

/// With these weights of squares of differences the wave energies together count as one signal, by their mean.
[[nodiscard]] std::vector<double> selection_signal_weights();

/// Signals that tell a right registration from a turned one, what only feet, hands and faces show: logarithms of heat kernel signatures
/// at small times and of wave kernel signatures at high energies, (V, selection_signal_names()). Scaled so that the two heat signals and
/// all wave energies together weigh alike.
[[nodiscard]] Eigen::MatrixXd selection_signals(const Eigen::VectorXd& values, const Eigen::MatrixXf& vectors);

/// What the names of eigenfunctions begin with that are stored as signals.
inline constexpr const char* eigenfunction_prefix = "eigenfunction_";

/// The names of these, by rising frequency and without the constant: of the lowest among the `eigenpairs` that there are.
[[nodiscard]] std::vector<std::string> eigenfunction_names(Eigen::Index eigenpairs);

}  // namespace spherematch
