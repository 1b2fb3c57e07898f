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

/// The best voxels, by falling correlation, none near a better one and none below `least` times the best. Not the grid's own maxima: on
/// a body nearly of revolution a peak is a low rise on a sharp ridge, which shows between the samples only.
std::vector<RotationCandidate> seeds(const CorrelationGrid& grid, double least) {
  constexpr std::size_t kMost = 64;
  constexpr double kApart = 0.7;  // squared Frobenius distance: 0.6 radians
  const double bound = least * *std::max_element(grid.values.begin(), grid.values.end());
  std::vector<std::size_t> voxels;
  for (std::size_t i = 0; i < grid.values.size(); ++i)
    if (grid.values[i] >= bound) voxels.push_back(i);
  std::stable_sort(voxels.begin(), voxels.end(), [&grid](std::size_t i, std::size_t j) { return grid.values[i] > grid.values[j]; });

  std::vector<RotationCandidate> result;
  const auto n = static_cast<std::size_t>(grid.n);
  const double step = 2 * std::numbers::pi / grid.n;
  for (const std::size_t i : voxels) {
    const auto beta = static_cast<double>(i / (n * n)), alpha = static_cast<double>(i / n % n), gamma = static_cast<double>(i % n);
    const Eigen::Matrix3d rotation = euler_rotation(alpha * step, (beta + 0.5) * step / 2, gamma * step);
    const bool apart = std::all_of(result.begin(), result.end(),
                                   [&](const RotationCandidate& better) { return (better.rotation - rotation).squaredNorm() > kApart; });
    if (apart) result.push_back({rotation, grid.values[i]});
    if (result.size() == kMost) break;
  }
  return result;
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

/// Newton's method for the maximum of the correlation, in the rotation vector to the left of the current rotation. False where it comes
/// to one of the maxima that are known.
bool refine(RotationCandidate& candidate, const std::vector<Signal>& source, const std::vector<Signal>& target,
            const std::vector<RotationCandidate>& known) {
  constexpr double kThere = 0.02;  // squared Frobenius distance: 0.1 radians, the longest step
  for (int iteration = 0; iteration < 20; ++iteration) {
    double value = 0;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
    const CoefficientRotation rotate(static_cast<int>(source.front().size()) - 1, candidate.rotation);
    for (std::size_t c = 0; c < source.size(); ++c) {
      const Signal rotated = rotate(source[c]);
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
    const auto is_here = [&](const RotationCandidate& maximum) { return (maximum.rotation - candidate.rotation).squaredNorm() < kThere; };
    if (std::any_of(known.begin(), known.end(), is_here)) return false;
  }
  return true;
}

}  // namespace

std::vector<RotationCandidate> align_rotations(const std::vector<Harmonics>& source, const std::vector<Harmonics>& target, int degree,
                                               const MatchParameters& parameters) {
  std::vector<Signal> f, g;
  for (const Harmonics& h : source) f.push_back(normalized(h, degree));
  for (const Harmonics& h : target) g.push_back(normalized(h, degree));
  const double channels = static_cast<double>(source.size());

  // A seed's value is below that of the peak which it leads to, but not by much.
  std::vector<RotationCandidate> refined;
  for (RotationCandidate& seed : seeds(correlate(f, g, degree), 1 - 2 * parameters.candidate_threshold))
    if (refine(seed, f, g, refined)) refined.push_back(seed);
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
    const Signal rotated = CoefficientRotation(degree, rotation)(normalized(source[c], degree)), g = normalized(target[c], degree);
    for (std::size_t l = 1; l < rotated.size(); ++l) value += g[l].dot(rotated[l]).real();
  }
  return value / static_cast<double>(source.size());
}

Eigen::Matrix3d half_rotation(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd whole(rotation);
  return Eigen::AngleAxisd(whole.angle() / 2, whole.axis()).toRotationMatrix();
}

}  // namespace spherematch
