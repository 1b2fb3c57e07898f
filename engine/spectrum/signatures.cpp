#include "engine/spectrum/signatures.h"

#include <algorithm>
#include <cmath>

namespace spherematch {

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

}  // namespace spherematch
