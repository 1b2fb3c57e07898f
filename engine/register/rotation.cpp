#include "engine/register/rotation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/register/wigner.h"
#include "engine/sphere/fourier.h"

namespace spherematch {
namespace {

using Complex = std::complex<double>;
using Signal = std::vector<DegreeVector>;  ///< element l has the coefficients m = -l..l

/// Centred and of unit norm, so that signals of different scale count alike.
Signal normalized(const Harmonics& coefficients, int degree) {
  Harmonics a = coefficients;
  a[0] = 0;
  const double norm = std::sqrt(harmonic_dot(degree, a, a));
  if (norm > 0) a /= norm;
  return full_coefficients(degree, a);
}

/// Correlation values on the Euler grid: alpha and gamma at 2 pi k / n, beta at pi (j + 1/2) / n, n = 2 (degree + 1).
struct CorrelationGrid {
  int n;
  std::vector<double> values;  ///< [beta][alpha][gamma]
  [[nodiscard]] double at(int beta, int alpha, int gamma) const {
    return values[(static_cast<std::size_t>(beta) * static_cast<std::size_t>(n) + static_cast<std::size_t>((alpha + n) % n)) *
                      static_cast<std::size_t>(n) +
                  static_cast<std::size_t>((gamma + n) % n)];
  }
};

CorrelationGrid correlate(const std::vector<Signal>& source, const std::vector<Signal>& target, int degree) {
  const int n = 2 * (degree + 1);
  const auto size = static_cast<std::size_t>(n);
  CorrelationGrid grid{n, std::vector<double>(size * size * size)};
  std::vector<Complex> spectrum(size * (size / 2 + 1));
  const PlaneFourier fourier(n);
  for (int j = 0; j < n; ++j) {
    const std::vector<Eigen::MatrixXd> d = wigner_d(degree, std::numbers::pi * (j + 0.5) / n);
    std::fill(spectrum.begin(), spectrum.end(), Complex(0));
    for (std::size_t c = 0; c < source.size(); ++c)
      for (int l = 1; l <= degree; ++l) {
        const auto L = static_cast<std::size_t>(l);
        for (int m = -l; m <= l; ++m) {
          // C(R) is a sum of exp(-i (m alpha + n gamma)); the transform has exp(+i ...) and wants gamma's half of the spectrum.
          const Complex g = std::conj(target[c][L][m + l]);
          Complex* row = spectrum.data() + static_cast<std::size_t>((n - m) % n) * (size / 2 + 1);
          for (int k = 0; k <= l; ++k) row[k] += d[L](m + l, l - k) * g * source[c][L][l - k];
        }
      }
    fourier.backward(spectrum.data(), grid.values.data() + static_cast<std::size_t>(j) * size * size);
  }
  return grid;
}

Eigen::Matrix3d euler_rotation(double alpha, double beta, double gamma) {
  return (Eigen::AngleAxisd(alpha, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(beta, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(gamma, Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

/// Voxels that no neighbour exceeds, best first.
std::vector<RotationCandidate> grid_maxima(const CorrelationGrid& grid) {
  std::vector<RotationCandidate> maxima;
  const auto is_maximum = [&](int b, int a, int g, double value) {
    for (int db = -1; db <= 1; ++db) {
      if (b + db < 0 || b + db >= grid.n) continue;
      for (int da = -1; da <= 1; ++da)
        for (int dg = -1; dg <= 1; ++dg)
          if (grid.at(b + db, a + da, g + dg) > value) return false;
    }
    return true;
  };
  for (int b = 0; b < grid.n; ++b)
    for (int a = 0; a < grid.n; ++a)
      for (int g = 0; g < grid.n; ++g) {
        const double value = grid.at(b, a, g), step = 2 * std::numbers::pi / grid.n;
        if (is_maximum(b, a, g, value)) maxima.push_back({euler_rotation(a * step, (b + 0.5) * step / 2, g * step), value});
      }
  std::stable_sort(maxima.begin(), maxima.end(), [](const auto& x, const auto& y) { return x.correlation > y.correlation; });
  return maxima;
}

/// J a for the angular momentum operators J_x, J_y, J_z on one degree.
DegreeVector momentum(int axis, const DegreeVector& a) {
  const int l = static_cast<int>(a.size() - 1) / 2;
  DegreeVector result = DegreeVector::Zero(a.size());
  for (int m = -l; m <= l; ++m) {
    if (axis == 2) {
      result[m + l] = static_cast<double>(m) * a[m + l];
      continue;
    }
    const Complex raise = axis == 0 ? Complex(0.5) : Complex(0, -0.5), lower = std::conj(raise);
    if (m < l) result[m + 1 + l] += raise * std::sqrt((l - m) * (l + m + 1.0)) * a[m + l];
    if (m > -l) result[m - 1 + l] += lower * std::sqrt((l + m) * (l - m + 1.0)) * a[m + l];
  }
  return result;
}

/// Newton's method for the maximum of the correlation, in the rotation vector to the left of the current rotation.
void refine(RotationCandidate& candidate, const std::vector<Signal>& source, const std::vector<Signal>& target) {
  for (int iteration = 0; iteration < 20; ++iteration) {
    double value = 0;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
    for (std::size_t c = 0; c < source.size(); ++c) {
      const Signal rotated = rotate_coefficients(source[c], candidate.rotation);
      for (std::size_t l = 1; l < rotated.size(); ++l) {
        const DegreeVector& g = target[c][l];
        value += g.dot(rotated[l]).real();
        DegreeVector first[3], transposed[3];
        for (int i = 0; i < 3; ++i) {
          first[i] = momentum(i, rotated[l]);
          transposed[i] = momentum(i, g);
          gradient[i] += g.dot(first[i]).imag();  // Re(-i x) = Im x
        }
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) hessian(i, j) -= 0.5 * (transposed[i].dot(first[j]) + transposed[j].dot(first[i])).real();
      }
    }
    candidate.correlation = value;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(hessian);
    // Away from a maximum follow the gradient in directions of the wrong curvature.
    const Eigen::Vector3d curvature = eigen.eigenvalues().cwiseAbs().cwiseMax(1e-9 * eigen.eigenvalues().cwiseAbs().maxCoeff() + 1e-300);
    Eigen::Vector3d step = eigen.eigenvectors() * (eigen.eigenvectors().transpose() * gradient).cwiseQuotient(curvature);
    const double length = step.norm();
    if (length < 1e-12) break;
    if (length > 0.1) step *= 0.1 / length;
    candidate.rotation = Eigen::AngleAxisd(step.norm(), step.normalized()).toRotationMatrix() * candidate.rotation;
  }
}

}  // namespace

std::vector<RotationCandidate> align_rotations(const std::vector<Harmonics>& source, const std::vector<Harmonics>& target, int degree,
                                               const MatchParameters& parameters) {
  std::vector<Signal> f, g;
  for (const Harmonics& h : source) f.push_back(normalized(h, degree));
  for (const Harmonics& h : target) g.push_back(normalized(h, degree));
  const double channels = static_cast<double>(source.size());

  std::vector<RotationCandidate> refined;
  for (RotationCandidate& maximum : grid_maxima(correlate(f, g, degree))) {
    const bool hopeless = !refined.empty() && maximum.correlation < (1 - 2 * parameters.candidate_threshold) * refined.front().correlation;
    if (hopeless || refined.size() >= 64) break;  // refinement gains little over the grid's value
    refine(maximum, f, g);
    refined.push_back(maximum);
  }
  std::stable_sort(refined.begin(), refined.end(), [](const auto& a, const auto& b) { return a.correlation > b.correlation; });

  std::vector<RotationCandidate> kept;
  for (const RotationCandidate& candidate : refined) {
    if (static_cast<int>(kept.size()) >= parameters.max_candidates) break;
    if (!kept.empty() && candidate.correlation < (1 - parameters.candidate_threshold) * kept.front().correlation) break;
    const bool separated = std::all_of(kept.begin(), kept.end(), [&](const RotationCandidate& better) {
      return (better.rotation - candidate.rotation).squaredNorm() > parameters.candidate_separation;
    });
    if (separated) kept.push_back(candidate);
  }
  for (RotationCandidate& candidate : kept) candidate.correlation /= channels;
  if (kept.empty()) kept.push_back({Eigen::Matrix3d::Identity(), 0});
  return kept;
}

double rotation_correlation(const std::vector<Harmonics>& source, const std::vector<Harmonics>& target, int degree,
                            const Eigen::Matrix3d& rotation) {
  double value = 0;
  for (std::size_t c = 0; c < source.size(); ++c) {
    const Signal rotated = rotate_coefficients(normalized(source[c], degree), rotation), g = normalized(target[c], degree);
    for (std::size_t l = 1; l < rotated.size(); ++l) value += g[l].dot(rotated[l]).real();
  }
  return value / static_cast<double>(source.size());
}

Eigen::Matrix3d half_rotation(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd whole(rotation);
  return Eigen::AngleAxisd(whole.angle() / 2, whole.axis()).toRotationMatrix();
}

}  // namespace spherematch
