#include "engine/sphere/harmonics.h"

#include <libsharp/sharp.h>
#include <libsharp/sharp_almhelpers.h>
#include <libsharp/sharp_geomhelpers.h>

namespace spherematch {
namespace {

// One thread per transform: they are short, and the pipeline runs whole stages in parallel.
constexpr int kFlags = SHARP_DP | SHARP_NO_OPENMP;

}  // namespace

struct HarmonicTransform::Implementation {
  int resolution;
  int degree;
  sharp_geom_info* quadrature = nullptr;  ///< rings with quadrature weights
  sharp_alm_info* coefficients = nullptr;

  Implementation(int n, int l) : resolution(n), degree(l) {
    sharp_make_fejer1_geom_info(n, n, std::numbers::pi / n, 1, n, &quadrature);
    sharp_make_triangular_alm_info(l, l, 1, &coefficients);
  }
  ~Implementation() {
    sharp_destroy_geom_info(quadrature);
    sharp_destroy_alm_info(coefficients);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void execute(sharp_jobtype job, int spin, void** alm, void** map) const {
    sharp_execute(job, spin, static_cast<void*>(alm), static_cast<void*>(map), quadrature, coefficients, kFlags, nullptr, nullptr);
  }
};

HarmonicTransform::HarmonicTransform(int resolution, int degree) : implementation_(std::make_unique<Implementation>(resolution, degree)) {}
HarmonicTransform::~HarmonicTransform() = default;
HarmonicTransform::HarmonicTransform(HarmonicTransform&&) noexcept = default;
HarmonicTransform& HarmonicTransform::operator=(HarmonicTransform&&) noexcept = default;

int HarmonicTransform::resolution() const { return implementation_->resolution; }
int HarmonicTransform::degree() const { return implementation_->degree; }

Harmonics HarmonicTransform::analyze(const Grid& values) const {
  Harmonics result(harmonic_count(degree()));
  void* alm[] = {result.data()};
  void* map[] = {const_cast<double*>(values.data())};  // libsharp reads it only
  implementation_->execute(SHARP_MAP2ALM, 0, alm, map);
  return result;
}

Grid HarmonicTransform::synthesize(const Harmonics& coefficients) const {
  Grid result(resolution(), resolution());
  void* alm[] = {const_cast<std::complex<double>*>(coefficients.data())};
  void* map[] = {result.data()};
  implementation_->execute(SHARP_ALM2MAP, 0, alm, map);
  return result;
}

// libsharp's spin-1 basis is the gradient and the turned gradient of Y_lm divided by sqrt(l (l + 1)).
TangentGrid HarmonicTransform::synthesize_tangent(const Harmonics& gradient, const Harmonics& curl) const {
  const auto factor = [](int l) { return std::sqrt(l * (l + 1.0)); };
  Harmonics e = gradient, b = curl;
  scale_degrees(degree(), e, factor);
  scale_degrees(degree(), b, factor);
  TangentGrid result{Grid(resolution(), resolution()), Grid(resolution(), resolution())};
  void* alm[] = {e.data(), b.data()};
  void* map[] = {result.colatitude.data(), result.longitude.data()};
  implementation_->execute(SHARP_ALM2MAP, 1, alm, map);
  return result;
}

void HarmonicTransform::adjoint_tangent(const TangentGrid& field, Harmonics& gradient, Harmonics& curl) const {
  gradient.resize(harmonic_count(degree()));
  curl.resize(harmonic_count(degree()));
  void* alm[] = {gradient.data(), curl.data()};
  void* map[] = {const_cast<double*>(field.colatitude.data()), const_cast<double*>(field.longitude.data())};
  implementation_->execute(SHARP_Yt, 1, alm, map);
  const auto factor = [](int l) { return std::sqrt(l * (l + 1.0)); };
  scale_degrees(degree(), gradient, factor);
  scale_degrees(degree(), curl, factor);
}

double harmonic_dot(int degree, const Harmonics& a, const Harmonics& b) {
  double zonal = 0, rest = 0;
  for (int l = 0; l <= degree; ++l) zonal += a[l].real() * b[l].real();
  for (Eigen::Index i = degree + 1; i < a.size(); ++i) rest += a[i].real() * b[i].real() + a[i].imag() * b[i].imag();
  return zonal + 2 * rest;
}

}  // namespace spherematch
