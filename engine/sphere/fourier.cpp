#include "engine/sphere/fourier.h"

#include <fftw3.h>

#include <mutex>
#include <vector>

namespace spherematch {
namespace {

/// FFTW's planner is the one part of it that must not run twice at a time.
std::mutex& planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

fftw_complex* raw(std::complex<double>* values) { return reinterpret_cast<fftw_complex*>(values); }
fftw_plan plan_of(const std::shared_ptr<void>& plan) { return static_cast<fftw_plan>(plan.get()); }

template <typename Make>
std::shared_ptr<void> planned(const Make& make) {
  const std::scoped_lock lock(planner_mutex());
  return {make(), [](void* plan) {
            const std::scoped_lock locked(planner_mutex());
            fftw_destroy_plan(static_cast<fftw_plan>(plan));
          }};
}

constexpr unsigned kRule = FFTW_ESTIMATE | FFTW_UNALIGNED;  // any array may be transformed later

}  // namespace

RowFourier::RowFourier(int length, int rows) : length_(length) {
  std::vector<double> values(static_cast<std::size_t>(length) * static_cast<std::size_t>(rows));
  std::vector<std::complex<double>> spectrum(static_cast<std::size_t>(frequencies()) * static_cast<std::size_t>(rows));
  const int n = frequencies();
  forward_ = planned([&] {
    return fftw_plan_many_dft_r2c(1, &length, rows, values.data(), nullptr, 1, length, raw(spectrum.data()), nullptr, 1, n,
                                  kRule | FFTW_PRESERVE_INPUT);
  });
  backward_ = planned([&] {
    return fftw_plan_many_dft_c2r(1, &length, rows, raw(spectrum.data()), nullptr, 1, n, values.data(), nullptr, 1, length, kRule);
  });
}

void RowFourier::forward(const double* values, std::complex<double>* spectrum) const {
  fftw_execute_dft_r2c(plan_of(forward_), const_cast<double*>(values), raw(spectrum));  // the plan preserves its input
}

void RowFourier::backward(std::complex<double>* spectrum, double* values) const {
  fftw_execute_dft_c2r(plan_of(backward_), raw(spectrum), values);
}

PlaneFourier::PlaneFourier(int size) {
  const auto n = static_cast<std::size_t>(size);
  std::vector<double> values(n * n);
  std::vector<std::complex<double>> spectrum(n * (n / 2 + 1));
  backward_ = planned([&] { return fftw_plan_dft_c2r_2d(size, size, raw(spectrum.data()), values.data(), kRule); });
}

void PlaneFourier::backward(std::complex<double>* spectrum, double* values) const {
  fftw_execute_dft_c2r(plan_of(backward_), raw(spectrum), values);
}

}  // namespace spherematch
