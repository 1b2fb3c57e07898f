#include "engine/register/functional_map.h"

#include <Eigen/Cholesky>

#include "engine/register/for_runs.h"

namespace spherematch {

SpectralDifferences spectral_differences(const Eigen::Ref<const PointValues>& resting, const Eigen::Ref<const PointValues>& moving,
                                         const Eigen::VectorXd& masses, int threads) {
  const Eigen::Index nodes = resting.rows(), k = resting.cols();
  // Products within a run of nodes in single precision, their sums in double.
  const Eigen::MatrixXd products = sum_over_runs(nodes, threads, [&](Eigen::Index first, Eigen::Index last) -> Eigen::MatrixXd {
    PointValues both(last - first, 2 * k);
    both << resting.middleRows(first, last - first), moving.middleRows(first, last - first);
    const PointValues weighted = masses.segment(first, last - first).cast<float>().asDiagonal() * both.leftCols(k);
    return (weighted.transpose() * both).cast<double>();
  });
  const Eigen::MatrixXf map = products.leftCols(k).ldlt().solve(products.rightCols(k)).cast<float>();

  SpectralDifferences result{PointValues(nodes, k), {}};
  const Eigen::MatrixXd squares = sum_over_runs(nodes, threads, [&](Eigen::Index first, Eigen::Index last) -> Eigen::MatrixXd {
    const auto own = moving.middleRows(first, last - first);
    auto values = result.values.middleRows(first, last - first);
    values = own;
    values.noalias() -= resting.middleRows(first, last - first) * map;
    const Eigen::RowVectorXf m = masses.segment(first, last - first).transpose().cast<float>();
    Eigen::MatrixXd sums(2, k);
    sums << (m * own.cwiseAbs2()).cast<double>(), (m * values.cwiseAbs2()).cast<double>();
    return sums;
  });
  const auto all = squares.row(0).array(), unexplained = squares.row(1).array();
  result.explained = (all > 0).select((1 - unexplained / all).cwiseMax(0), 0.0).cast<float>();
  return result;
}

}  // namespace spherematch
