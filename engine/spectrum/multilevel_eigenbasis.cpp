#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "engine/spectrum/eigenbasis.h"
#include "engine/spectrum/hierarchy.h"
#include "engine/spectrum/pencil.h"
#include "engine/spectrum/shift_inverse.h"
#include "engine/spectrum/subspace.h"
#include "engine/spectrum/work_meter.h"

namespace spherematch {

namespace {

constexpr double kShift = -10.0;        // below the spectrum, so that the shifted matrix is positive definite; of the order of a gap
constexpr double kRatio = 4.5;          // of vertices between levels
constexpr double kFineColumns = 1.11;   // on the finest level, over the pairs wanted: those near the last wanted converge slowest
constexpr double kCoarseColumns = 1.4;  // on the others, where vectors cost little
constexpr double kCoarsest = 1.75;      // vertices of the coarsest level, over its vectors
constexpr int kFirstRounds = 8;         // of inverse iteration after the coarsest level, which knows the upper half of the pairs badly
constexpr Eigen::Index kMostCounted = 12'000;  // vertices of levels on which eigenvalues are counted
constexpr int kSmoothing = 8;                  // steps, on larger levels
constexpr double kSmoothed = 1.0 / 15;         // down to this part of the highest frequency
constexpr int kMostRepairs = 3;                // further rounds on the finest level where residuals are too large
constexpr double kMostResidual = 0.05;         // over the eigenvalue and an eighth of the last one

constexpr Eigen::Index kWidth = FloatShiftInverse::width;

Eigen::Index columns_for(Eigen::Index wanted, double factor) {
  return static_cast<Eigen::Index>(std::ceil(static_cast<double>(wanted) * factor / static_cast<double>(kWidth))) * kWidth;
}

/// Values at the finer vertices of the first `columns` functions.
FloatBlock prolong(const FloatBlock& coarse, const Interpolation& interpolation, Eigen::Index columns, WorkMeter& meter) {
  FloatBlock fine(interpolation.rows(), columns);
  for (Eigen::Index v = 0; v < fine.rows(); ++v) {
    if (v % 16384 == 0) meter.progress().check();
    auto row = fine.row(v);
    row.setZero();
    for (Interpolation::InnerIterator entry(interpolation, v); entry; ++entry)
      row += static_cast<float>(entry.value()) * coarse.row(entry.col()).head(columns);
  }
  return fine;
}

/// The eigenproblem on one level.
class Level {
 public:
  Level(const Laplacian& laplacian, Eigen::Index most_factorized, int threads, WorkMeter& meter)
      : pencil_(laplacian), threads_(threads), meter_(meter) {
    meter.progress().check();
    if (pencil_.rows() <= most_factorized) inverse_ = std::make_unique<const FloatShiftInverse>(laplacian, kShift);
    meter.progress().check();
  }

  /// Improves the subspace; false when it lost a dimension.
  [[nodiscard]] bool improve(Subspace& subspace, int rounds) const {
    for (int round = 0; round < rounds; ++round) {
      if (inverse_)
        iterate_inversely(subspace, pencil_, *inverse_, kShift, threads_, meter_);
      else
        smooth(subspace, pencil_, kSmoothing, kSmoothed, threads_, meter_);
      const bool last = round + 1 == rounds;
      if (!(last ? project(subspace, pencil_, threads_, meter_) : orthonormalize(subspace, pencil_, threads_, meter_))) return false;
    }
    return true;
  }

  /// Whether the first `wanted` pairs solve the problem.
  [[nodiscard]] bool is_solved(const Subspace& subspace, Eigen::Index wanted) const {
    const Eigen::ArrayXd sizes = subspace.values.head(wanted).array() + subspace.values[wanted - 1] / 8;
    return (residuals(subspace, pencil_, threads_, meter_).head(wanted).array() <= kMostResidual * sizes).all();
  }

 private:
  Pencil pencil_;
  std::unique_ptr<const FloatShiftInverse> inverse_;  ///< empty on a level too large for it
  int threads_;
  WorkMeter& meter_;
};

/// By Sylvester's law of inertia: whether there are as many eigenvalues below some bound as there are `values`. The bound is in
/// the widest gap among the last quarter of them.
bool is_complete(const Laplacian& laplacian, const Eigen::VectorXd& values) {
  Eigen::Index at = values.size() - 1;
  for (Eigen::Index i = at; i > values.size() * 3 / 4; --i)
    if (values[i] - values[i - 1] > values[at] - values[at - 1]) at = i;
  const double bound = (values[at] + values[at - 1]) / 2;
  const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower> factors(laplacian.stiffness - bound * laplacian.mass);
  if (factors.info() != Eigen::Success) return true;  // an eigenvalue to rounding: nothing can be said
  return (factors.vectorD().array() < 0).count() == at;
}

/// How often the subspace is improved on level `l`, above the coarsest: most where the start is worst, and once more where a mesh is so
/// small that this costs little.
int rounds_on(std::size_t l, std::size_t level_count) {
  if (l + 1 == level_count) return kFirstRounds;
  return l == 0 && level_count == 2 ? 2 : 1;
}

/// Improves the pairs of one level, and checks them as far as that is done on it. Nothing where they are not good enough.
[[nodiscard]] bool solve_level(Subspace& subspace, const Laplacian& laplacian, const Level& level, Eigen::Index wanted, int rounds,
                               bool finest, bool counted) {
  if (!level.improve(subspace, rounds)) return false;
  if (counted && !is_complete(laplacian, subspace.values.head(wanted))) return false;
  for (int repair = 0; finest && !level.is_solved(subspace, wanted); ++repair)
    if (repair == kMostRepairs || !level.improve(subspace, 1)) return false;
  return true;
}

}  // namespace

std::optional<FloatEigenbasis> compute_eigenbasis_by_levels(const TriMesh& mesh, const Laplacian& laplacian, int count, int threads,
                                                            const Progress& progress, const std::function<void(double)>& report,
                                                            Eigen::Index most_factorized) {
  const Eigen::Index wanted = count, columns = columns_for(wanted, kCoarseColumns), fine_columns = columns_for(wanted, kFineColumns);
  const auto coarsest = static_cast<Eigen::Index>(kCoarsest * static_cast<double>(columns));
  if (4 * mesh.vertex_count() < 5 * coarsest) return std::nullopt;
  const std::vector<CoarseLevel> levels = coarse_levels(mesh, laplacian, coarsest, kRatio, progress);
  if (levels.empty() || levels.back().laplacian.mass.rows() > 2 * coarsest) return std::nullopt;

  const auto problem = [&](std::size_t l) -> const Laplacian& { return l == 0 ? laplacian : levels[l - 1].laplacian; };
  WorkMeter meter(progress, report);
  for (std::size_t l = 0; l < levels.size(); ++l)
    meter.plan(static_cast<double>(problem(l).mass.rows()) * (3 * rounds_on(l, levels.size()) + (l == 0 ? 1 : 0)));

  Eigenbasis start = compute_eigenbasis(levels.back().laplacian, static_cast<int>(columns), progress);
  Subspace subspace{start.vectors.cast<float>(), std::move(start.values)};
  for (std::size_t l = levels.size(); l-- > 0;) {
    const Eigen::Index kept = l == 0 ? fine_columns : columns;
    subspace.vectors = prolong(subspace.vectors, levels[l].interpolation, kept, meter);
    subspace.values.conservativeResize(kept);
    // Counted once, on the last level that is small enough.
    const bool count_now = problem(l).mass.rows() <= kMostCounted && (l == 0 || problem(l - 1).mass.rows() > kMostCounted);
    const Level level(problem(l), most_factorized, threads, meter);
    if (!solve_level(subspace, problem(l), level, wanted, rounds_on(l, levels.size()), l == 0, count_now)) return std::nullopt;
  }
  return FloatEigenbasis{subspace.values.head(wanted), subspace.vectors.leftCols(wanted)};
}

}  // namespace spherematch
