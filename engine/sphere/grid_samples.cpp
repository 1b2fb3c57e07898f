#include "engine/sphere/grid_samples.h"

#include <algorithm>

namespace spherematch {
namespace {

constexpr int kBorder = 2;

/// Weights of the samples at -1, 0, 1, 2 for a value at `t` in [0, 1].
Eigen::Array4f cubic_weights(double t) {
  const double u = 1 - t;
  return Eigen::Array4d(-0.5 * t * u * u, 1 + t * t * (1.5 * t - 2.5), 1 + u * u * (1.5 * u - 2.5), -0.5 * u * t * t).cast<float>();
}

}  // namespace

GridSamples::GridSamples(const std::vector<Grid>& channels)
    : resolution_(static_cast<int>(channels.front().rows())), stride_(resolution_ + 2 * kBorder), channels_(channels.size()) {
  const int n = resolution_;
  constexpr auto kPack = static_cast<std::size_t>(pack_size);
  packs_.assign((channels_ + kPack - 1) / kPack, std::vector<Pack>(static_cast<std::size_t>(stride_ * stride_), Pack::Zero()));
  for (std::size_t c = 0; c < channels_; ++c) {
    const Grid& grid = channels[c];
    Pack* pack = packs_[c / kPack].data();
    const auto place = static_cast<Eigen::Index>(c % kPack);
    for (int j = -kBorder; j < n + kBorder; ++j) {
      // Beyond a pole lies the opposite meridian.
      const bool beyond = j < 0 || j >= n;
      const int row = j < 0 ? -1 - j : j >= n ? 2 * n - 1 - j : j;
      for (int i = -kBorder; i < n + kBorder; ++i)
        pack[(j + kBorder) * stride_ + i + kBorder][place] = static_cast<float>(grid(row, (i + n + (beyond ? n / 2 : 0)) % n));
    }
  }
}

GridSamples::Stencil GridSamples::stencil(const GridPlace& place) const {
  const int n = resolution_;
  const double r = place.colatitude * n + 0.5, c = place.longitude * n + 0.5;
  const int row = std::clamp(static_cast<int>(r), 0, n), column = std::clamp(static_cast<int>(c), 0, n);
  // The samples at row - 1 and row, counted from the first centre, enclose p; one more lies on each side.
  return {(row - 2 + kBorder) * stride_ + column - 2 + kBorder, cubic_weights(r - row), cubic_weights(c - column)};
}

}  // namespace spherematch
