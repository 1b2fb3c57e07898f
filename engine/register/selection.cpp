#include "engine/register/selection.h"

#include <cmath>
#include <vector>

#include "engine/sphere/harmonics.h"

namespace spherematch {
namespace {

double mean_over_sphere(const Grid& values) {
  const Eigen::ArrayXd areas = cell_areas(static_cast<int>(values.rows())).array();
  return (values.colwise() * areas).sum() / (areas.sum() * static_cast<double>(values.rows()));
}

}  // namespace

double registration_cost(const GridSamples& source_signals, const Points& source_origins, const GridSamples& target_signals,
                         const Points& target_origins, int resolution) {
  const std::size_t packs = source_signals.packs();
  std::vector<GridSamples::Pack> values(packs * static_cast<std::size_t>(source_origins.rows()));
  source_signals.for_each_stencil(source_origins, [&](Eigen::Index node, const GridSamples::Stencil& stencil) {
    for (std::size_t pack = 0; pack < packs; ++pack) values[static_cast<std::size_t>(node) * packs + pack] = source_signals(stencil, pack);
  });
  Grid difference(resolution, resolution);
  target_signals.for_each_stencil(target_origins, [&](Eigen::Index node, const GridSamples::Stencil& stencil) {
    double sum = 0;
    for (std::size_t pack = 0; pack < packs; ++pack)
      sum += (values[static_cast<std::size_t>(node) * packs + pack] - target_signals(stencil, pack)).abs().sum();
    difference.data()[node] = sum / static_cast<double>(source_signals.channels());
  });
  return mean_over_sphere(difference);
}

double paper_cost(const GridSamples& source_signal, const Points& source_origins, const GridSamples& target_signal,
                  const Points& target_origins, int resolution) {
  const int degree = resolution / 2 - 1;
  const double bandwidth = 0.5 * resolution, time = std::log(100.0) / (bandwidth * (bandwidth + 1));
  const HarmonicTransform transform(resolution, degree);
  const auto smoothed = [&](const GridSamples& signal, const Points& origins) {
    Grid values(resolution, resolution);
    signal.for_each_stencil(origins,
                            [&](Eigen::Index node, const GridSamples::Stencil& stencil) { values.data()[node] = signal(stencil, 0)[0]; });
    Harmonics a = transform.analyze(values);
    scale_degrees(degree, a, [time](int l) { return std::exp(-time * l * (l + 1)); });
    return transform.synthesize(a);
  };
  return mean_over_sphere((smoothed(source_signal, source_origins) - smoothed(target_signal, target_origins)).abs());
}

}  // namespace spherematch
