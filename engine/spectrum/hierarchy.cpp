#include "engine/spectrum/hierarchy.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "engine/mesh/coarsen.h"

namespace spherematch {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

/// Entry of both matrices.
struct Entry {
  std::int32_t column;
  double stiffness, mass;
};

/// Whole rows of both matrices, side by side.
struct Rows {
  std::vector<std::int64_t> start;
  std::vector<Entry> entries;
};

Rows rows_of(const Laplacian& laplacian) {
  const int *outer = laplacian.stiffness.outerIndexPtr(), *inner = laplacian.stiffness.innerIndexPtr();
  const auto count = static_cast<std::int32_t>(laplacian.stiffness.rows());
  Rows rows{std::vector<std::int64_t>(at(count) + 1, 0), {}};
  for (std::int32_t j = 0; j < count; ++j)
    for (int k = outer[j]; k < outer[j + 1]; ++k) {
      ++rows.start[at(j) + 1];
      if (inner[k] != j) ++rows.start[at(inner[k]) + 1];
    }
  for (std::size_t i = 1; i < rows.start.size(); ++i) rows.start[i] += rows.start[i - 1];
  rows.entries.resize(at(rows.start.back()));
  std::vector<std::int64_t> next(rows.start.begin(), rows.start.end() - 1);
  for (std::int32_t j = 0; j < count; ++j)
    for (int k = outer[j]; k < outer[j + 1]; ++k) {
      const double s = laplacian.stiffness.valuePtr()[k], m = laplacian.mass.valuePtr()[k];
      rows.entries[at(next[at(j)]++)] = {inner[k], s, m};
      if (inner[k] != j) rows.entries[at(next[at(inner[k])]++)] = {j, s, m};
    }
  return rows;
}

/// Collects one column of both products.
class Column {
 public:
  explicit Column(Eigen::Index size) : slot_(at(size), -1) {}

  void add(std::int32_t row, double stiffness, double mass) {
    std::int32_t& slot = slot_[at(row)];
    if (slot < 0) {
      slot = static_cast<std::int32_t>(entries_.size());
      entries_.push_back({row, 0, 0});
    }
    entries_[at(slot)].stiffness += stiffness;
    entries_[at(slot)].mass += mass;
  }

  /// Calls take(entry) by rising row, and is empty again.
  template <typename Take>
  void flush(const Take& take) {
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
    for (const Entry& e : entries_) {
      slot_[at(e.column)] = -1;
      take(e);
    }
    entries_.clear();
  }

 private:
  std::vector<std::int32_t> slot_;
  std::vector<Entry> entries_;
};

}  // namespace

Laplacian galerkin_product(const Laplacian& laplacian, const Interpolation& interpolation, const Progress& progress) {
  const Rows rows = rows_of(laplacian);
  const SparseMatrix by_column = interpolation;
  const Eigen::Index size = interpolation.cols();
  const int *start = interpolation.outerIndexPtr(), *index = interpolation.innerIndexPtr();
  const double* weight = interpolation.valuePtr();
  std::vector<int> outer{0}, inner;
  std::vector<double> stiffness, mass;
  Column column(size);
  for (std::int32_t c = 0; c < size; ++c) {
    if (c % 8192 == 0) progress.check();
    for (SparseMatrix::InnerIterator fine(by_column, c); fine; ++fine)
      for (std::int64_t k = rows.start[at(fine.row())]; k < rows.start[at(fine.row()) + 1]; ++k) {
        const Entry& e = rows.entries[at(k)];
        const double s = fine.value() * e.stiffness, m = fine.value() * e.mass;
        for (int p = start[e.column]; p < start[e.column + 1]; ++p)
          if (index[p] >= c) column.add(index[p], weight[p] * s, weight[p] * m);
      }
    column.flush([&](const Entry& e) {
      inner.push_back(e.column);
      stiffness.push_back(e.stiffness);
      mass.push_back(e.mass);
    });
    outer.push_back(static_cast<int>(inner.size()));
  }
  const auto matrix = [&](const std::vector<double>& values) {
    return SparseMatrix(
        Eigen::Map<const SparseMatrix>(size, size, static_cast<Eigen::Index>(inner.size()), outer.data(), inner.data(), values.data()));
  };
  return {matrix(stiffness), matrix(mass)};
}

std::vector<CoarseLevel> coarse_levels(const TriMesh& mesh, const Laplacian& laplacian, Eigen::Index coarsest, double ratio,
                                       const Progress& progress) {
  std::vector<CoarseLevel> levels;
  TriMesh current;
  const TriMesh* finer = &mesh;
  while (finer->vertex_count() > coarsest) {
    // Steps of one size, the last of which ends at the coarsest.
    const double size = static_cast<double>(finer->vertex_count()), shrink = size / static_cast<double>(coarsest);
    const double steps = std::max(1.0, std::round(std::log(shrink) / std::log(ratio)));
    const auto vertices =
        static_cast<std::int32_t>(std::max<double>(static_cast<double>(coarsest), std::floor(size / std::pow(shrink, 1 / steps))));
    std::optional<CoarseMesh> coarse = coarsen(*finer, vertices, progress);
    if (!coarse) return levels;
    Interpolation prolong = interpolation(*coarse);
    levels.push_back({galerkin_product(levels.empty() ? laplacian : levels.back().laplacian, prolong, progress), std::move(prolong)});
    progress.check();
    current = std::move(coarse->mesh);
    finer = &current;
  }
  return levels;
}

}  // namespace spherematch
