// Associated Legendre functions at the colatitudes of a grid, for spherical harmonic transforms.
#pragma once

#include <Eigen/Core>

namespace spherematch {

/// Values on the northern half of an N-row grid (engine/sphere/grid.h); the southern follow by parity. Column harmonic_index(L, l, m) of
/// each table has (N + 1) / 2 rows, of colatitudes pi (j + 1/2) / N. Takes 12 N L^2 bytes. Immutable.
struct LegendreTables {
  LegendreTables(int resolution, int degree);

  Eigen::MatrixXd value;       ///< P: orthonormal on the sphere with exp(i m longitude), Condon-Shortley phase
  Eigen::MatrixXd derivative;  ///< dP / d colatitude
  Eigen::MatrixXd order;       ///< m P / sin(colatitude)
};

}  // namespace spherematch
