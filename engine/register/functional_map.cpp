#include "engine/register/functional_map.h"

#include <Eigen/Cholesky>

namespace spherematch {

SpectralDifferences spectral_differences(const Eigen::Ref<const PointValues>& resting, const Eigen::Ref<const PointValues>& moving,
                                         const Eigen::VectorXd& masses) {
  const PointValues weighted = masses.asDiagonal() * resting;
  const Eigen::MatrixXd gram = resting.transpose() * weighted, products = weighted.transpose() * moving;
  SpectralDifferences result;
  result.values = moving - resting * gram.ldlt().solve(products);
  const auto squares = [&masses](const auto& values) -> Eigen::RowVectorXd { return masses.transpose() * values.cwiseAbs2(); };
  const Eigen::RowVectorXd all = squares(moving), unexplained = squares(result.values);
  result.explained = (all.array() > 0).select((1 - unexplained.array() / all.array()).cwiseMax(0), 0.0);
  return result;
}

}  // namespace spherematch
