#include "engine/sphere/harmonics.h"

#include <cmath>
#include <numbers>

#include "engine/sphere/fourier.h"
#include "engine/sphere/legendre.h"

namespace spherematch {
namespace {

/// Weights of Fejer's first rule for the integral over the sphere, of one cell in each row.
Eigen::VectorXd quadrature_weights(int n) {
  Eigen::VectorXd weights(n);
  for (int j = 0; j < n; ++j) {
    const double colatitude = std::numbers::pi * (j + 0.5) / n;
    double sum = 1;
    for (int k = 1; k <= n / 2; ++k) sum -= 2 * std::cos(2 * k * colatitude) / (4.0 * k * k - 1);
    weights[j] = 2.0 / n * sum * 2 * std::numbers::pi / n;
  }
  return weights;
}

using Complex = std::complex<double>;

}  // namespace

struct HarmonicTransform::Tables {
  Tables(int n, int highest) : degree(highest), legendre(n, highest), fourier(n, n), weights(quadrature_weights(n)), turn(highest + 1) {
    for (int m = 0; m <= highest; ++m) turn[m] = std::polar(1.0, std::numbers::pi * m / n);
  }

  [[nodiscard]] Eigen::Index column(int l, int m) const { return harmonic_index(degree, l, m); }

  /// Coefficients of order m, turned from longitude zero to the centre of the first column, where the Fourier transforms begin; and back.
  [[nodiscard]] Complex forth(int m, const Complex& a) const {
    const Complex t = turn[m];
    return {a.real() * t.real() - a.imag() * t.imag(), a.real() * t.imag() + a.imag() * t.real()};
  }
  [[nodiscard]] Complex back(int m, double real, double imaginary) const {
    const Complex t = turn[m];
    return {real * t.real() + imaginary * t.imag(), imaginary * t.real() - real * t.imag()};
  }

  int degree;
  LegendreTables legendre;
  RowFourier fourier;
  Eigen::VectorXd weights;  ///< (N)
  Eigen::VectorXcd turn;    ///< exp(i m longitude) at the centre of the first column
};

/// Fourier coefficients of the rows for m = 0..degree, as sums (even) and differences (odd) of mirrored rows, (half the rows,
/// 2 * (degree + 1)): columns 2 m and 2 m + 1 are real and imaginary part. Against these a Legendre function, which is even or odd
/// itself, is needed on one hemisphere only.
struct HarmonicTransform::Halves {
  Halves(int resolution, int degree) : even((resolution + 1) / 2, 2 * (degree + 1)), odd(even.rows(), even.cols()) {}

  /// The half that meets a function of the parity of l + m (of l + m + 1 for derivatives).
  [[nodiscard]] auto part(int parity, int m) { return (parity % 2 == 0 ? even : odd).middleCols<2>(2 * m); }
  [[nodiscard]] auto part(int parity, int m) const { return (parity % 2 == 0 ? even : odd).middleCols<2>(2 * m); }

  void set_zero() {
    even.setZero();
    odd.setZero();
  }

  Eigen::MatrixXd even, odd;
};

HarmonicTransform::HarmonicTransform(int resolution, int degree)
    : resolution_(resolution), degree_(degree), tables_(std::make_shared<const Tables>(resolution, degree)) {}

HarmonicTransform HarmonicTransform::truncated(int degree) const {
  HarmonicTransform result = *this;
  result.degree_ = degree;
  return result;
}

HarmonicTransform::Halves HarmonicTransform::fold(const Grid& values, const Eigen::VectorXd* weights) const {
  const Eigen::Index n = resolution_, frequencies = tables_->fourier.frequencies();
  Eigen::MatrixXcd spectrum(frequencies, n);
  tables_->fourier.forward(values.data(), spectrum.data());
  Halves halves(resolution_, degree_);
  for (Eigen::Index j = 0; j < halves.even.rows(); ++j) {
    const Eigen::Index mirrored = n - 1 - j;
    const double weight = weights ? (*weights)[j] : 1.0;
    const double mirror_weight = mirrored == j ? 0 : weight;
    for (int m = 0; m <= degree_; ++m) {
      const Complex north = weight * spectrum(m, j), south = mirror_weight * spectrum(m, mirrored);
      const Complex sum = north + south, difference = mirrored == j ? Complex(0) : north - south;
      halves.even(j, 2 * m) = sum.real();
      halves.even(j, 2 * m + 1) = sum.imag();
      halves.odd(j, 2 * m) = difference.real();
      halves.odd(j, 2 * m + 1) = difference.imag();
    }
  }
  return halves;
}

Grid HarmonicTransform::unfold(const Halves& halves) const {
  const Eigen::Index n = resolution_;
  Eigen::MatrixXcd spectrum = Eigen::MatrixXcd::Zero(tables_->fourier.frequencies(), n);
  for (Eigen::Index j = 0; j < halves.even.rows(); ++j)
    for (int m = 0; m <= degree_; ++m) {
      const Complex even(halves.even(j, 2 * m), halves.even(j, 2 * m + 1)), odd(halves.odd(j, 2 * m), halves.odd(j, 2 * m + 1));
      spectrum(m, n - 1 - j) = even - odd;
      spectrum(m, j) = even + odd;
    }
  Grid result(n, n);
  tables_->fourier.backward(spectrum.data(), result.data());
  return result;
}

Harmonics HarmonicTransform::analyze(const Grid& values) const {
  const Halves halves = fold(values, &tables_->weights);
  Harmonics result(harmonic_count(degree_));
  for (int m = 0; m <= degree_; ++m)
    for (int l = m; l <= degree_; ++l) {
      const auto function = tables_->legendre.value.col(tables_->column(l, m));
      const auto half = halves.part(l + m, m);
      result[harmonic_index(degree_, l, m)] = tables_->back(m, function.dot(half.col(0)), function.dot(half.col(1)));
    }
  return result;
}

Grid HarmonicTransform::synthesize(const Harmonics& coefficients) const {
  Halves halves(resolution_, degree_);
  halves.set_zero();
  for (int m = 0; m <= degree_; ++m)
    for (int l = m; l <= degree_; ++l) {
      const Complex a = tables_->forth(m, coefficients[harmonic_index(degree_, l, m)]);
      const auto function = tables_->legendre.value.col(tables_->column(l, m));
      auto half = halves.part(l + m, m);
      half.col(0) += a.real() * function;
      half.col(1) += a.imag() * function;
    }
  return unfold(halves);
}

// With P' the derivative and Q = m P / sin, the gradient of a P exp(i m longitude) has the components (a P', i a Q), and p x gradient
// of b P exp(i m longitude) the components (-i b Q, b P').

TangentGrid HarmonicTransform::synthesize_tangent(const Harmonics& gradient, const Harmonics& curl) const {
  Halves colatitude(resolution_, degree_), longitude(resolution_, degree_);
  colatitude.set_zero();
  longitude.set_zero();
  for (int m = 0; m <= degree_; ++m)
    for (int l = m; l <= degree_; ++l) {
      const Eigen::Index at = harmonic_index(degree_, l, m), column = tables_->column(l, m);
      const auto derivative = tables_->legendre.derivative.col(column), order = tables_->legendre.order.col(column);
      const int parity = l + m;
      if (gradient.size() > 0) {
        const Complex a = tables_->forth(m, gradient[at]);
        auto south = colatitude.part(parity + 1, m), east = longitude.part(parity, m);
        south.col(0) += a.real() * derivative;
        south.col(1) += a.imag() * derivative;
        east.col(0) -= a.imag() * order;
        east.col(1) += a.real() * order;
      }
      if (curl.size() > 0) {
        const Complex b = tables_->forth(m, curl[at]);
        auto south = colatitude.part(parity, m), east = longitude.part(parity + 1, m);
        south.col(0) += b.imag() * order;
        south.col(1) -= b.real() * order;
        east.col(0) += b.real() * derivative;
        east.col(1) += b.imag() * derivative;
      }
    }
  return {unfold(colatitude), unfold(longitude)};
}

void HarmonicTransform::adjoint_tangent(const TangentGrid& field, Harmonics* gradient, Harmonics* curl) const {
  const Halves colatitude = fold(field.colatitude, nullptr), longitude = fold(field.longitude, nullptr);
  if (gradient) gradient->resize(harmonic_count(degree_));
  if (curl) curl->resize(harmonic_count(degree_));
  for (int m = 0; m <= degree_; ++m)
    for (int l = m; l <= degree_; ++l) {
      const Eigen::Index at = harmonic_index(degree_, l, m), column = tables_->column(l, m);
      const auto derivative = tables_->legendre.derivative.col(column), order = tables_->legendre.order.col(column);
      const int parity = l + m;
      if (gradient) {
        const auto south = colatitude.part(parity + 1, m), east = longitude.part(parity, m);
        (*gradient)[at] =
            tables_->back(m, derivative.dot(south.col(0)) + order.dot(east.col(1)), derivative.dot(south.col(1)) - order.dot(east.col(0)));
      }
      if (curl) {
        const auto south = colatitude.part(parity, m), east = longitude.part(parity + 1, m);
        (*curl)[at] =
            tables_->back(m, derivative.dot(east.col(0)) - order.dot(south.col(1)), derivative.dot(east.col(1)) + order.dot(south.col(0)));
      }
    }
}

double harmonic_dot(int degree, const Harmonics& a, const Harmonics& b) {
  double zonal = 0, rest = 0;
  for (int l = 0; l <= degree; ++l) zonal += a[l].real() * b[l].real();
  for (Eigen::Index i = degree + 1; i < a.size(); ++i) rest += a[i].real() * b[i].real() + a[i].imag() * b[i].imag();
  return zonal + 2 * rest;
}

}  // namespace spherematch
