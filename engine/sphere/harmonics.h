// Spherical harmonic transforms between a Grid and coefficients, scalar and tangential (libsharp underneath).
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

/// Transforms at one grid resolution and one degree. Immutable; const members may be called from several threads.
class HarmonicTransform {
 public:
  /// Exact for band-limited functions when degree <= (resolution - 1) / 2.
  HarmonicTransform(int resolution, int degree);
  ~HarmonicTransform();
  HarmonicTransform(HarmonicTransform&&) noexcept;
  HarmonicTransform& operator=(HarmonicTransform&&) noexcept;

  [[nodiscard]] int resolution() const;
  [[nodiscard]] int degree() const;

  /// Quadrature on the cell centres (Fejer's first rule).
  [[nodiscard]] Harmonics analyze(const Grid& values) const;
  [[nodiscard]] Grid synthesize(const Harmonics& coefficients) const;

  /// Gradient of the potential `gradient` plus the gradient of `curl` turned by 90 degrees counter-clockwise (p x grad).
  [[nodiscard]] TangentGrid synthesize_tangent(const Harmonics& gradient, const Harmonics& curl) const;

  /// Transpose of synthesize_tangent with respect to the plain sum over cells on one side and
  /// harmonic_dot on the other.
  void adjoint_tangent(const TangentGrid& field, Harmonics& gradient, Harmonics& curl) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
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
