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

/// One grid per channel.
std::vector<Grid> on_grid(const RegisteredSignals& side, int resolution) {
  std::vector<Grid> grids(side.channels.size(), Grid(resolution, resolution));
  side.signals.for_each_stencil(side.origins, [&](Eigen::Index node, const GridSamples::Stencil& stencil) {
    side.signals.for_each_value(stencil, side.channels, [&](std::size_t c, float value) { grids[c].data()[node] = value; });
  });
  return grids;
}

}  // namespace

double registration_cost(const RegisteredSignals& source, const RegisteredSignals& target, const std::vector<double>& weights,
                         int resolution) {
  const std::vector<Grid> f = on_grid(source, resolution), g = on_grid(target, resolution);
  double squares = 0, weight = 0;
  for (std::size_t c = 0; c < f.size(); ++c) {
    squares += weights[c] * mean_over_sphere((f[c] - g[c]).square());
    weight += weights[c];
  }
  return std::sqrt(squares / weight);
}

double paper_cost(const RegisteredSignals& source, const RegisteredSignals& target, int resolution) {
  const int degree = resolution / 2 - 1;
  const double bandwidth = 0.5 * resolution, time = std::log(100.0) / (bandwidth * (bandwidth + 1));
  const HarmonicTransform transform(resolution, degree);
  const auto smoothed = [&](const Grid& grid) {
    Harmonics a = transform.analyze(grid);
    scale_degrees(degree, a, [time](int l) { return std::exp(-time * l * (l + 1)); });
    return transform.synthesize(a);
  };
  const std::vector<Grid> f = on_grid(source, resolution), g = on_grid(target, resolution);
  double cost = 0;
  for (std::size_t c = 0; c < f.size(); ++c) cost += mean_over_sphere((smoothed(f[c]) - smoothed(g[c])).abs());
  return cost / static_cast<double>(f.size());
}

}  // namespace spherematch
