// Real Fourier transforms of the rows of a grid and of a plane (FFTW underneath). Plans choose by rule, not by measuring, so that the
// same input gives the same bytes.
#pragma once

#include <complex>
#include <memory>

namespace spherematch {

/// Transforms of `rows` rows of `length` reals each, one behind the other. Immutable; const members may be called from several threads.
class RowFourier {
 public:
  RowFourier(int length, int rows);

  /// Frequencies 0 .. length / 2 of each row: row j of the result begins at j * frequencies().
  void forward(const double* values, std::complex<double>* spectrum) const;
  /// The unscaled inverse. Overwrites the spectrum.
  void backward(std::complex<double>* spectrum, double* values) const;

  [[nodiscard]] int frequencies() const { return length_ / 2 + 1; }

 private:
  int length_;
  std::shared_ptr<void> forward_, backward_;
};

/// The unscaled inverse transform of a (size, size / 2 + 1) half spectrum to (size, size) reals. Thread-safe as above.
class PlaneFourier {
 public:
  explicit PlaneFourier(int size);

  /// Overwrites the spectrum.
  void backward(std::complex<double>* spectrum, double* values) const;

 private:
  std::shared_ptr<void> backward_;
};

}  // namespace spherematch
