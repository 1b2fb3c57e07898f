#include "engine/spectrum/signatures.h"

#include <algorithm>
#include <cmath>

namespace spherematch {
namespace {

constexpr int kEnergies = 16;  ///< of which the upper half is used

}  // namespace

Eigen::MatrixXd heat_kernel_signatures(const Eigen::VectorXd& values, const Eigen::MatrixXf& vectors, const std::vector<double>& times) {
  Eigen::MatrixXd weights(values.size(), static_cast<Eigen::Index>(times.size()));
  for (std::size_t t = 0; t < times.size(); ++t) weights.col(static_cast<Eigen::Index>(t)) = (-times[t] * values.array()).exp();
  return vectors.cast<double>().cwiseAbs2() * weights;
}

Eigen::MatrixXd wave_kernel_signatures(const Eigen::VectorXd& values, const Eigen::MatrixXf& vectors, int count) {
  const Eigen::Index k = values.size();
  const Eigen::ArrayXd logs = values.array().max(1e-6).log();
  const double low = logs[std::min<Eigen::Index>(1, k - 1)], high = logs[k - 1];
  const double width = std::max(7 * (high - low) / count, 0.1);  // a spectrum of one or two values has no range
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(k, count);
  for (int e = 0; e < count; ++e) {
    const double energy = low + (high - low) * e / std::max(1, count - 1);
    weights.col(e).tail(k - 1) = (-(energy - logs.tail(k - 1)).square() / (2 * width * width)).exp();
    weights.col(e) /= weights.col(e).sum();
  }
  return vectors.cast<double>().cwiseAbs2() * weights;
}

std::vector<std::string> heat_detail_names() { return {"log_hks_0.003", "log_hks_0.001"}; }

std::vector<std::string> selection_signal_names() {
  std::vector<std::string> names = heat_detail_names();
  for (int energy = kEnergies / 2; energy < kEnergies; ++energy) names.push_back("log_wks_" + std::to_string(energy));
  return names;
}

std::vector<double> selection_signal_weights() {
  std::vector<double> weights(selection_signal_names().size(), kEnergies / 2.0);
  weights[0] = weights[1] = 1;
  return weights;
}

std::vector<std::string> eigenfunction_names(Eigen::Index eigenpairs) {
  constexpr Eigen::Index kStored = 60;
  std::vector<std::string> names;
  for (Eigen::Index i = 1; i < eigenpairs && i <= kStored; ++i) names.push_back(eigenfunction_prefix + std::to_string(i));
  return names;
}

Eigen::MatrixXd selection_signals(const Eigen::VectorXd& values, const Eigen::MatrixXf& vectors) {
  const Eigen::MatrixXd heat = heat_kernel_signatures(values, vectors, {0.003, 0.001}).array().max(1e-12).log();
  const Eigen::MatrixXd wave = wave_kernel_signatures(values, vectors, kEnergies).rightCols(kEnergies / 2).array().max(1e-12).log();
  Eigen::MatrixXd signals(heat.rows(), heat.cols() + wave.cols());
  signals << heat, wave / static_cast<double>(wave.cols());
  return signals;
}

}  // namespace spherematch
