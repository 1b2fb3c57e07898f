// The density of mass that a spherical triangulation carries, by samples: a stand-in for rasterize_mass where the density is smoothed
// afterwards, many times faster.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/data/tri_mesh.h"
#include "engine/sphere/grid.h"

namespace spherematch {

/// Every face is cut into strips and these into samples about a cell apart; each sample spreads its mass bilinearly over the four
/// cells round it. There are half as many rows as the grid has, and towards the poles they have fewer cells, so that all cells are
/// about square and of one size and none is left without a sample.
/// Immutable; const members may be called from several threads.
class DensitySampler {
 public:
  explicit DensitySampler(int resolution);  ///< even, at least 8

  /// log(density + floor) at the cell centres of the (N, N) grid, for `face_mass` (F) spread evenly over each flat face. Densities are
  /// per solid angle. `floor` > 0 keeps cells finite that no face reaches.
  [[nodiscard]] Grid log_density(const Points& sphere, const Triangles& faces, const Eigen::VectorXd& face_mass, double floor) const;

 private:
  friend class SampleSpreader;

  struct Row {
    int columns;        ///< cells round the sphere
    std::size_t start;  ///< of the row's first cell
    double weight;      ///< solid angle that one cell stands for
  };
  [[nodiscard]] std::vector<double> masses(const Points& sphere, const Triangles& faces, const Eigen::VectorXd& face_mass) const;

  int resolution_;
  std::vector<Row> rows_;
};

}  // namespace spherematch
