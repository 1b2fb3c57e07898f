// Functions on the sphere that are given at the cell centres of a Grid, evaluated anywhere.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "engine/data/tri_mesh.h"
#include "engine/sphere/grid.h"
#include "engine/sphere/grid_place.h"

namespace spherematch {

/// Several functions (channels) on one grid, interpolated by cubic convolution (Keys 1981), whose error is of third order in the
/// size of a cell. In single precision, as shapes are stored: what is read is limited by memory. Channels go in packs of eight, the last
/// one filled up with zeros. Immutable, thread-safe.
class GridSamples {
 public:
  static constexpr Eigen::Index pack_size = 8;
  using Pack = Eigen::Array<float, pack_size, 1>;

  /// Which samples an evaluation reads, and their weights; the same for all channels.
  struct Stencil {
    std::ptrdiff_t first;  ///< of the 16 samples
    Eigen::Array4f rows, columns;
  };

  /// At least one channel; all of one resolution N, which is even.
  explicit GridSamples(const std::vector<Grid>& channels);

  [[nodiscard]] std::size_t bytes() const { return packs_.size() * packs_.front().size() * sizeof(Pack); }
  [[nodiscard]] std::size_t packs() const { return packs_.size(); }
  [[nodiscard]] std::size_t channels() const { return channels_; }

  [[nodiscard]] Stencil stencil(const GridPlace& place) const;

  /// Calls visit(i, stencil) for each of the unit vectors `points` (P, 3).
  template <typename Visit>
  void for_each_stencil(const Points& points, const Visit& visit) const {
    constexpr Eigen::Index kBatch = 64;  // places are found for several at once
    std::array<GridPlace, kBatch> places;
    for (Eigen::Index first = 0; first < points.rows(); first += kBatch) {
      const Eigen::Index count = std::min(kBatch, points.rows() - first);
      const double* p = points.data() + 3 * first;
      for (Eigen::Index i = 0; i < count; ++i) places[static_cast<std::size_t>(i)] = grid_place(p[3 * i], p[3 * i + 1], p[3 * i + 2]);
      for (Eigen::Index i = 0; i < count; ++i) visit(first + i, stencil(places[static_cast<std::size_t>(i)]));
    }
  }

  /// Calls visit(c, value) for the value of each channels[c]. Cheapest where channels of one pack follow each other.
  template <typename Visit>
  void for_each_value(const Stencil& at, const std::vector<Eigen::Index>& channels, const Visit& visit) const {
    Eigen::Index pack = -1;
    Pack values;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      if (channels[c] / pack_size != pack) values = (*this)(at, static_cast<std::size_t>(pack = channels[c] / pack_size));
      visit(c, values[channels[c] % pack_size]);
    }
  }

  /// The values of the channels from pack_size * pack on.
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
