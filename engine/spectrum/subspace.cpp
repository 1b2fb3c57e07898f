#include "engine/spectrum/subspace.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/data/parallel.h"

namespace spherematch {

namespace {

constexpr Eigen::Index kRowsAtOnce = 1024;  // of products that go into a Gram matrix: they stay in the cache
constexpr Eigen::Index kPieces = 8;         // of the rows, each summed by itself, so that sums do not depend on the threads
constexpr double kLeastPivot = 1e-3;        // of a Gram matrix of unit vectors in single precision
constexpr int kWidth = FloatShiftInverse::width;

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

/// Calls task(piece, first row, row count) for chunks of the rows, those of one piece in their order on one thread.
template <typename Task>
void for_each_chunk(Eigen::Index rows, int threads, WorkMeter& meter, const Task& task) {
  run_parallel(kPieces, threads, [&](std::size_t piece) {
    const auto p = static_cast<Eigen::Index>(piece);
    const Eigen::Index end = rows * (p + 1) / kPieces;
    for (Eigen::Index row = rows * p / kPieces; row < end; row += kRowsAtOnce) {
      const Eigen::Index count = std::min(kRowsAtOnce, end - row);
      task(piece, row, count);
      meter.add(static_cast<double>(count));
    }
  });
}

/// V^T S V and V^T M V of vectors that are scaled to a length of one, lower triangles; the first only when asked for.
struct GramMatrices {
  Eigen::MatrixXd stiffness, mass;
  Eigen::VectorXd scale;
};

GramMatrices gram_matrices(const FloatBlock& vectors, const Pencil& pencil, bool with_stiffness, int threads, WorkMeter& meter) {
  const Eigen::Index m = vectors.cols();
  std::vector<GramMatrices> sums(at(kPieces), {Eigen::MatrixXd::Zero(m, m), Eigen::MatrixXd::Zero(m, m), {}});
  for_each_chunk(vectors.rows(), threads, meter, [&](std::size_t piece, Eigen::Index first, Eigen::Index count) {
    FloatBlock stiffness(count, m), mass(count, m);
    pencil.multiply(vectors, first, count, stiffness, mass);
    const auto rows = vectors.middleRows(first, count);
    Eigen::MatrixXf product = Eigen::MatrixXf::Zero(m, m);
    product.triangularView<Eigen::Lower>() += rows.transpose() * mass;
    sums[piece].mass += product.cast<double>();
    if (!with_stiffness) return;
    product.setZero();
    product.triangularView<Eigen::Lower>() += rows.transpose() * stiffness;
    sums[piece].stiffness += product.cast<double>();
  });
  GramMatrices result = sums[0];
  for (std::size_t piece = 1; piece < sums.size(); ++piece) {
    result.stiffness += sums[piece].stiffness;
    result.mass += sums[piece].mass;
  }
  result.scale = result.mass.diagonal().cwiseSqrt().cwiseInverse();
  for (Eigen::MatrixXd* matrix : {&result.stiffness, &result.mass})
    *matrix = (result.scale.asDiagonal() * *matrix * result.scale.asDiagonal()).eval();
  return result;
}

/// The Cholesky factor of the mass, unless the vectors are nearly dependent.
std::optional<Eigen::LLT<Eigen::MatrixXd>> factor_of(const GramMatrices& gram) {
  Eigen::LLT<Eigen::MatrixXd> factor(gram.mass);
  if (factor.info() != Eigen::Success || !(factor.matrixLLT().diagonal().minCoeff() > kLeastPivot)) return std::nullopt;
  return factor;
}

void recombine(FloatBlock& vectors, const Eigen::MatrixXf& weights, int threads, WorkMeter& meter) {
  for_each_chunk(vectors.rows(), threads, meter, [&](std::size_t, Eigen::Index first, Eigen::Index count) {
    auto rows = vectors.middleRows(first, count);
    rows = (rows * weights).eval();
  });
}

}  // namespace

void iterate_inversely(Subspace& subspace, const Pencil& pencil, const FloatShiftInverse& inverse, double sigma, int threads,
                       WorkMeter& meter) {
  const Eigen::Index rows = subspace.vectors.rows(), columns = subspace.vectors.cols();
  run_parallel(at(columns / kWidth), threads, [&](std::size_t task) {
    const auto first = static_cast<Eigen::Index>(task) * kWidth;
    const Eigen::Array<float, 1, kWidth> scale = (subspace.values.segment<kWidth>(first).array() - sigma).cast<float>().transpose();
    FloatShiftInverse::Block work(rows, kWidth);
    std::array<float, Pencil::group> ignored;
    for (Eigen::Index v = 0; v < rows; ++v)
      for (Eigen::Index c = 0; c < kWidth; c += Pencil::group)
        pencil.multiply(v, subspace.vectors.data() + first + c, columns, ignored.data(), &work(inverse.place(v), c));
    meter.progress().check();
    inverse.apply_in_place(work);
    for (Eigen::Index v = 0; v < rows; ++v) subspace.vectors.row(v).segment<kWidth>(first) = work.row(inverse.place(v)).array() * scale;
    meter.add(static_cast<double>(rows * kWidth) / static_cast<double>(columns));
  });
}

bool orthonormalize(Subspace& subspace, const Pencil& pencil, int threads, WorkMeter& meter) {
  const GramMatrices gram = gram_matrices(subspace.vectors, pencil, false, threads, meter);
  const auto factor = factor_of(gram);
  if (!factor) return false;
  Eigen::MatrixXd weights = gram.scale.asDiagonal();
  factor->matrixU().solveInPlace<Eigen::OnTheRight>(weights);
  recombine(subspace.vectors, weights.cast<float>(), threads, meter);
  return true;
}

bool project(Subspace& subspace, const Pencil& pencil, int threads, WorkMeter& meter) {
  const GramMatrices gram = gram_matrices(subspace.vectors, pencil, true, threads, meter);
  if (!factor_of(gram)) return false;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram.stiffness, gram.mass);
  if (solver.info() != Eigen::Success) return false;
  subspace.values = solver.eigenvalues();
  recombine(subspace.vectors, (gram.scale.asDiagonal() * solver.eigenvectors()).cast<float>(), threads, meter);
  return true;
}

void smooth(Subspace& subspace, const Pencil& pencil, int steps, double part, int threads, WorkMeter& meter) {
  using Values = Eigen::Array<float, 1, Pencil::group>;
  using Panel = Eigen::Matrix<float, Eigen::Dynamic, Pencil::group, Eigen::RowMajor>;
  const Eigen::Index rows = subspace.vectors.rows(), columns = subspace.vectors.cols();
  const double highest = pencil.highest_frequency(), lowest = part * highest;
  const double middle = (highest + lowest) / 2, half = (highest - lowest) / 2;
  run_parallel(at(columns / Pencil::group), threads, [&](std::size_t task) {
    const auto first = static_cast<Eigen::Index>(task) * Pencil::group;
    const Values value = subspace.values.segment<Pencil::group>(first).cast<float>().transpose();
    Panel residual(rows, Pencil::group), change(rows, Pencil::group), next(rows, Pencil::group);
    // The residual of column j is lambda_j M x - S x.
    const auto subtract = [&](Eigen::Index v, const float* x, Eigen::Index stride, const auto& from) {
      Values s, m;
      pencil.multiply(v, x, stride, s.data(), m.data());
      return Values(from - (s - value * m));
    };
    const double start = half / middle;
    double rho = start;
    for (Eigen::Index v = 0; v < rows; ++v) {
      const Values r = subtract(v, subspace.vectors.data() + first, columns, Values::Zero());
      residual.row(v) = r;
      change.row(v) = r * (1 / (pencil.diagonal(v) * static_cast<float>(middle)));
    }
    for (int step = 0; step < steps; ++step) {
      meter.add(static_cast<double>(rows * Pencil::group) / static_cast<double>(columns * steps));
      const double next_rho = 1 / (2 / start - rho);
      const auto keep = static_cast<float>(next_rho * rho), add = static_cast<float>(2 * next_rho / half);
      rho = next_rho;
      for (Eigen::Index v = 0; v < rows; ++v) {
        subspace.vectors.row(v).segment<Pencil::group>(first) += change.row(v);
        if (step + 1 == steps) continue;
        const Values r = subtract(v, change.data(), Pencil::group, residual.row(v).array());
        residual.row(v) = r;
        next.row(v) = keep * change.row(v).array() + (add / pencil.diagonal(v)) * r;
      }
      change.swap(next);
    }
  });
}

Eigen::VectorXd residuals(const Subspace& subspace, const Pencil& pencil, int threads, WorkMeter& meter) {
  const Eigen::Index m = subspace.vectors.cols();
  std::vector<Eigen::ArrayXd> sums(at(kPieces), Eigen::ArrayXd::Zero(m));
  const Eigen::RowVectorXf values = subspace.values.cast<float>().transpose();
  for_each_chunk(subspace.vectors.rows(), threads, meter, [&](std::size_t piece, Eigen::Index first, Eigen::Index count) {
    FloatBlock stiffness(count, m), mass(count, m);
    pencil.multiply(subspace.vectors, first, count, stiffness, mass);
    stiffness.array() -= mass.array().rowwise() * values.array();
    for (Eigen::Index i = 0; i < count; ++i) stiffness.row(i) /= std::sqrt(pencil.lumped_mass(first + i));
    sums[piece] += stiffness.colwise().squaredNorm().transpose().cast<double>().array();
  });
  for (std::size_t piece = 1; piece < sums.size(); ++piece) sums[0] += sums[piece];
  return sums[0].sqrt();
}

}  // namespace spherematch
