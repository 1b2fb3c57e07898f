#include "engine/register/wigner.h"

#include <algorithm>
#include <cmath>

namespace spherematch {
namespace {

/// log(k!) for k up to `most`.
std::vector<double> log_factorials(int most) {
  std::vector<double> result{0};
  for (int k = 1; k <= most; ++k) result.push_back(result.back() + std::log(static_cast<double>(k)));
  return result;
}

}  // namespace

std::vector<Eigen::MatrixXd> wigner_d(int degree, double beta) {
  std::vector<Eigen::MatrixXd> d;
  for (int l = 0; l <= degree; ++l) d.emplace_back(2 * l + 1, 2 * l + 1);
  const double log_cosine = std::log(std::max(std::cos(beta / 2), 1e-300)), log_sine = std::log(std::max(std::sin(beta / 2), 1e-300));
  const double cosine = std::cos(beta);
  const std::vector<double> log_factorial = log_factorials(2 * degree);
  const auto factorial = [&log_factorial](int k) { return log_factorial[static_cast<std::size_t>(k)]; };
  // One quarter of the entries, m >= |n|; the others by d_{nm} = d_{-m,-n} = (-1)^{m-n} d_{mn} and d_{-n,-m} = d_{mn}.
  for (int m = 0; m <= degree; ++m)
    for (int n = -m; n <= m; ++n) {
      const double sign = (m - n) % 2 == 0 ? 1 : -1;
      // d^m_{mn} starts the recurrence; logarithms keep the binomials in range.
      const double log_binomial = factorial(2 * m) - factorial(m + n) - factorial(m - n);
      double previous = 0, current = sign * std::exp(0.5 * log_binomial + (m + n) * log_cosine + (m - n) * log_sine);
      for (int l = m; l <= degree; ++l) {
        Eigen::MatrixXd& matrix = d[static_cast<std::size_t>(l)];
        matrix(l + m, l + n) = matrix(l - n, l - m) = current;
        matrix(l + n, l + m) = matrix(l - m, l - n) = sign * current;
        const double up = l + 1.0, mm = m, nn = n, ll = l;
        const double scale = up * (2 * ll + 1) / std::sqrt((up * up - mm * mm) * (up * up - nn * nn));
        const double shift = l == 0 ? 0 : mm * nn / (ll * up);
        const double back = l == 0 ? 0 : std::sqrt((ll * ll - mm * mm) * (ll * ll - nn * nn)) / (ll * (2 * ll + 1));
        const double next = scale * ((cosine - shift) * current - back * previous);
        previous = current;
        current = next;
      }
    }
  return d;
}

std::vector<DegreeVector> full_coefficients(int degree, const Harmonics& coefficients) {
  std::vector<DegreeVector> result;
  for (int l = 0; l <= degree; ++l) {
    DegreeVector a(2 * l + 1);
    for (int m = 0; m <= l; ++m) {
      const std::complex<double> c = coefficients[harmonic_index(degree, l, m)];
      a[l + m] = c;
      a[l - m] = m % 2 == 0 ? std::conj(c) : -std::conj(c);
    }
    a[l] = a[l].real();
    result.push_back(std::move(a));
  }
  return result;
}

CoefficientRotation::CoefficientRotation(int degree, const Eigen::Matrix3d& rotation) {
  // R = Rz(alpha) Ry(beta) Rz(gamma)
  const double beta = std::atan2(std::hypot(rotation(0, 2), rotation(1, 2)), rotation(2, 2));
  if (std::sin(beta) > 1e-12) {
    alpha_ = std::atan2(rotation(1, 2), rotation(0, 2));
    gamma_ = std::atan2(rotation(2, 1), -rotation(2, 0));
  } else {  // only alpha + gamma, or alpha - gamma at the other pole, matters
    alpha_ = rotation(2, 2) > 0 ? std::atan2(rotation(1, 0), rotation(0, 0)) : std::atan2(-rotation(1, 0), -rotation(0, 0));
  }
  d_ = wigner_d(degree, beta);
}

std::vector<DegreeVector> CoefficientRotation::operator()(const std::vector<DegreeVector>& coefficients) const {
  const int degree = static_cast<int>(coefficients.size()) - 1;
  std::vector<DegreeVector> result;
  for (int l = 0; l <= degree; ++l) {
    DegreeVector a = coefficients[static_cast<std::size_t>(l)];
    for (int n = -l; n <= l; ++n) a[n + l] *= std::polar(1.0, -n * gamma_);
    DegreeVector b = d_[static_cast<std::size_t>(l)] * a;
    for (int m = -l; m <= l; ++m) b[m + l] *= std::polar(1.0, -m * alpha_);
    result.push_back(std::move(b));
  }
  return result;
}

}  // namespace spherematch
