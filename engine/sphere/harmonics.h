// Spherical harmonic transforms between a Grid and coefficients, scalar and tangential.
//
// Fourier transforms along the rows, then sums over tabulated Legendre functions: of the many transforms of one pair all share one table.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>

#include "engine/sphere/grid.h"

namespace spherematch {

/// Coefficients a_lm of a real function for 0 <= m <= l <= L in the orthonormal basis with the Condon-Shortley phase:
/// f = sum_l a_l0 Y_l0 + 2 Re sum_{m>0} a_lm Y_lm. Entry (l, m) is at harmonic_index(L, l, m).
using Harmonics = Eigen::VectorXcd;

inline Eigen::Index harmonic_count(int degree) { return static_cast<Eigen::Index>(degree + 1) * (degree + 2) / 2; }
inline Eigen::Index harmonic_index(int degree, int l, int m) { return static_cast<Eigen::Index>(m) * (2 * degree + 1 - m) / 2 + l; }

/// A tangent vector field on the grid: components towards growing colatitude and growing longitude.
struct TangentGrid {
  Grid colatitude;
  Grid longitude;
};

/// Transforms at one grid resolution and one degree. Copies share their tables. Immutable; const members may be called from several
/// threads.
class HarmonicTransform {
 public:
  /// Exact for band-limited functions when degree <= (resolution - 1) / 2.
  HarmonicTransform(int resolution, int degree);

  /// The same for a lower degree, at no cost.
  [[nodiscard]] HarmonicTransform truncated(int degree) const;

  [[nodiscard]] int resolution() const { return resolution_; }
  [[nodiscard]] int degree() const { return degree_; }

  /// Quadrature on the cell centres (Fejer's first rule).
  [[nodiscard]] Harmonics analyze(const Grid& values) const;
  [[nodiscard]] Grid synthesize(const Harmonics& coefficients) const;

  /// Gradient of the potential `gradient` plus the gradient of `curl` turned by 90 degrees counter-clockwise (p x grad). An empty vector
  /// stands for zero and saves half of the time.
  [[nodiscard]] TangentGrid synthesize_tangent(const Harmonics& gradient, const Harmonics& curl) const;

  /// Transpose of synthesize_tangent with respect to the plain sum over cells on one side and harmonic_dot on the other. Only what is
  /// not null is computed.
  void adjoint_tangent(const TangentGrid& field, Harmonics* gradient, Harmonics* curl) const;

 private:
  struct Tables;
  struct Halves;

  [[nodiscard]] Halves fold(const Grid& values, const Eigen::VectorXd* weights) const;
  [[nodiscard]] Grid unfold(const Halves& halves) const;

  int resolution_;
  int degree_;
  std::shared_ptr<const Tables> tables_;
};

/// Inner product of the two real functions over the sphere.
[[nodiscard]] double harmonic_dot(int degree, const Harmonics& a, const Harmonics& b);

/// a_lm -> factor(l) a_lm.
template <typename Factor>
void scale_degrees(int degree, Harmonics& coefficients, const Factor& factor) {
  for (int m = 0; m <= degree; ++m)
    for (int l = m; l <= degree; ++l) coefficients[harmonic_index(degree, l, m)] *= factor(l);
}

}  // namespace spherematch
