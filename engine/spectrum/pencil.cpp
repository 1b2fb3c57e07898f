#include "engine/spectrum/pencil.h"

#include <algorithm>
#include <cmath>

namespace spherematch {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

}  // namespace

Pencil::Pencil(const Laplacian& laplacian) {
  const SparseMatrix &s = laplacian.stiffness, &m = laplacian.mass;
  const Eigen::Index rows = s.rows();
  start_.assign(at(rows) + 1, 0);
  lumped_.resize(at(rows));
  diagonal_.resize(at(rows));
  // Both have one pattern, of the lower triangle by columns.
  const int *outer = s.outerIndexPtr(), *inner = s.innerIndexPtr();
  for (Eigen::Index j = 0; j < rows; ++j)
    for (int k = outer[j]; k < outer[j + 1]; ++k) {
      if (inner[k] == j) continue;
      ++start_[at(j) + 1];
      ++start_[at(inner[k]) + 1];
    }
  for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
  entries_.resize(at(start_.back()));
  std::vector<std::int64_t> next(start_.begin(), start_.end() - 1);
  std::vector<double> sums(at(rows), 0.0);
  for (std::int32_t j = 0; j < rows; ++j)
    for (int k = outer[j]; k < outer[j + 1]; ++k) {
      const std::int32_t i = inner[k];
      const double mass = m.valuePtr()[k];
      sums[at(i)] += mass;
      if (i == j) {
        diagonal_[at(i)] = static_cast<float>(s.valuePtr()[k]);
        continue;
      }
      sums[at(j)] += mass;
      const auto a = static_cast<float>(s.valuePtr()[k]), b = static_cast<float>(mass);
      entries_[at(next[at(i)]++)] = {j, a, b};
      entries_[at(next[at(j)]++)] = {i, a, b};
    }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    lumped_[i] = static_cast<float>(sums[i]);
    double beside = 0;
    for (std::int64_t k = start_[i]; k < start_[i + 1]; ++k) beside += std::abs(static_cast<double>(entries_[at(k)].stiffness));
    highest_frequency_ = std::max(highest_frequency_, 1 + beside / static_cast<double>(diagonal_[i]));
  }
}

void Pencil::multiply(Eigen::Index row, const float* x, Eigen::Index stride, float* stiffness, float* mass) const {
  using Values = Eigen::Array<float, 1, group>;
  const Values own = Eigen::Map<const Values>(x + row * stride);
  Values sx = Values::Zero(), mx = lumped_[at(row)] * own;
  for (std::int64_t k = start_[at(row)]; k < start_[at(row) + 1]; ++k) {
    const Entry& e = entries_[at(k)];
    const Values difference = Eigen::Map<const Values>(x + e.column * stride) - own;
    sx += e.stiffness * difference;
    mx += e.mass * difference;
  }
  Eigen::Map<Values>{stiffness} = sx;
  Eigen::Map<Values>{mass} = mx;
}

void Pencil::multiply(const FloatBlock& x, Eigen::Index first, Eigen::Index count, FloatBlock& stiffness, FloatBlock& mass) const {
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index c = 0; c < x.cols(); c += group) multiply(first + i, x.data() + c, x.cols(), &stiffness(i, c), &mass(i, c));
}

}  // namespace spherematch
