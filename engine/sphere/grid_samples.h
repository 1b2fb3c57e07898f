// Functions on the sphere that are given at the cell centres of a Grid, evaluated anywhere.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "engine/sphere/grid.h"

namespace spherematch {

/// Several functions (channels) on one grid, interpolated by cubic convolution (Keys 1981), whose error is of third order in the
/// size of a cell. Channels go in packs of four, the last one filled up with zeros. Immutable, thread-safe.
class GridSamples {
 public:
  using Pack = Eigen::Array4d;

  /// Which samples an evaluation reads, and their weights; the same for all channels.
  struct Stencil {
    std::ptrdiff_t first;  ///< of the 16 samples
    Eigen::Array4d rows, columns;
  };

  /// At least one channel; all of one resolution N, which is even.
  explicit GridSamples(const std::vector<Grid>& channels);

  [[nodiscard]] std::size_t packs() const { return packs_.size(); }
  [[nodiscard]] std::size_t channels() const { return channels_; }

  /// The stencil at the unit vector `p`.
  [[nodiscard]] Stencil stencil(const Eigen::Vector3d& p) const;

  /// The values of channels 4 * pack to 4 * pack + 3.
  [[nodiscard]] Pack operator()(const Stencil& at, std::size_t pack) const {
    const Pack* row = packs_[pack].data() + at.first;
    Pack sum = Pack::Zero();
    for (int j = 0; j < 4; ++j, row += stride_)
      sum += at.rows[j] * (at.columns[0] * row[0] + at.columns[1] * row[1] + at.columns[2] * row[2] + at.columns[3] * row[3]);
    return sum;
  }

 private:
  int resolution_;
  std::ptrdiff_t stride_;
  std::size_t channels_;
  std::vector<std::vector<Pack>> packs_;  ///< (N + 4) x (N + 4) each, a border of two cells on every side
};

}  // namespace spherematch
