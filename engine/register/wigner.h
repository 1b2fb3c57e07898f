// Rotation of spherical harmonic coefficients by Wigner matrices.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/sphere/harmonics.h"

namespace spherematch {

/// d^l_{mn}(beta) for l = 0..degree: element l is (2l + 1, 2l + 1) with row m + l and column n + l. Convention of Sakurai:
/// d^{1/2}_{1/2,-1/2} = -sin(beta / 2). By the three-term recurrence in l (Kostelec and Rockmore 2008).
[[nodiscard]] std::vector<Eigen::MatrixXd> wigner_d(int degree, double beta);

/// Coefficients of one degree for m = -l..l.
using DegreeVector = Eigen::VectorXcd;

/// All coefficients (l, m), m of both signs, of a real function; element l has 2l + 1 entries, m + l.
[[nodiscard]] std::vector<DegreeVector> full_coefficients(int degree, const Harmonics& coefficients);

/// One rotation R of any number of functions. Immutable.
class CoefficientRotation {
 public:
  CoefficientRotation(int degree, const Eigen::Matrix3d& rotation);

  /// Coefficients of x -> f(R^-1 x); f has the degree given above.
  [[nodiscard]] std::vector<DegreeVector> operator()(const std::vector<DegreeVector>& coefficients) const;

 private:
  double alpha_ = 0, gamma_ = 0;
  std::vector<Eigen::MatrixXd> d_;
};

}  // namespace spherematch
