#include "engine/sphere/legendre.h"

#include <cmath>
#include <numbers>

#include "engine/sphere/harmonics.h"

namespace spherematch {

LegendreTables::LegendreTables(int resolution, int degree)
    : value((resolution + 1) / 2, harmonic_count(degree)), derivative(value.rows(), value.cols()), order(value.rows(), value.cols()) {
  // The range of long double holds the powers of a small sine that the recurrence in l begins with.
  using Real = long double;
  for (Eigen::Index j = 0; j < value.rows(); ++j) {
    const Real colatitude = std::numbers::pi_v<Real> * (static_cast<Real>(j) + 0.5L) / resolution;
    const Real cosine = std::cos(colatitude), sine = std::sin(colatitude);
    Real diagonal = std::sqrt(0.25L * std::numbers::inv_pi_v<Real>);
    for (int m = 0; m <= degree; ++m) {
      if (m > 0) diagonal *= -sine * std::sqrt((2.0L * m + 1) / (2.0L * m));
      Real before = 0, current = diagonal, back = 0;  // `back` is the factor of P_{l-2} in the recurrence for P_l
      for (int l = m; l <= degree; ++l) {
        if (l > m) {
          const Real forth = std::sqrt((4.0L * l * l - 1) / (static_cast<Real>(l - m) * (l + m)));
          const Real next = forth * (cosine * current - back * before);
          before = current;
          current = next;
        }
        // (l^2 - m^2) / (4 l^2 - 1): what couples P_l with P_{l-1}, now for the derivative, then for the step after the next.
        const Real coupling = std::sqrt(static_cast<Real>(l - m) * (l + m) / (4.0L * l * l - 1));
        const Eigen::Index column = harmonic_index(degree, l, m);
        value(j, column) = static_cast<double>(current);
        derivative(j, column) = static_cast<double>((l * cosine * current - (2 * l + 1) * (l > m ? coupling : 0) * before) / sine);
        order(j, column) = static_cast<double>(m * current / sine);
        back = l > m ? coupling : 0;
      }
    }
  }
}

}  // namespace spherematch
