#include "engine/engine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <string>

#include "engine/data/parallel.h"
#include "engine/evaluate/evaluation.h"
#include "engine/evaluate/involution.h"
#include "engine/io/mesh_reader.h"
#include "engine/mesh/decimate.h"
#include "engine/mesh/laplacian.h"
#include "engine/mesh/repair.h"
#include "engine/register/registration.h"
#include "engine/spectrum/curvature.h"
#include "engine/spectrum/eigenbasis.h"
#include "engine/spectrum/signatures.h"
#include "engine/sphere/authalic_evolution.h"
#include "engine/sphere/conformal_flow.h"
#include "engine/sphere/flip_repair.h"
#include "engine/sphere/mobius.h"
#include "engine/sphere/orientation.h"
#include "engine/sphere/rasterizer.h"

namespace spherematch {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Merges the progress of two branches that run side by side into one fraction that never falls.
class JointProgress {
 public:
  JointProgress(const Progress& progress, double first_share) : progress_(progress), share_{first_share, 1 - first_share} {}

  void update(std::size_t branch, const char* stage, double fraction) {
    const std::scoped_lock lock(mutex_);
    done_[branch] = std::max(done_[branch], fraction);
    if (progress_.report) progress_.report(stage, share_[0] * done_[0] + share_[1] * done_[1]);
  }

 private:
  const Progress& progress_;
  std::mutex mutex_;
  double share_[2];
  double done_[2] = {0, 0};
};

/// Copy of the mesh, centred and of unit area: parameters are the same for every size.
TriMesh unit_area(const TriMesh& mesh) {
  TriMesh result = mesh;
  result.vertices.rowwise() -= mesh.vertices.colwise().mean().eval();
  result.vertices /= std::sqrt(face_areas(result.vertices, result.faces).sum());
  return result;
}

/// At this time chests and backs, feet and heels remain, and fingers do not: they seldom come to lie on each other.
constexpr double kCurvatureTime = 0.01;

constexpr double kConformalShare = 0.4;  ///< of the time of the sphere's branch

struct SphereBranch {
  Points sphere;
  StageSeconds seconds;
};

SphereBranch parametrize(const TriMesh& mesh, const PreprocessParameters& parameters, const Progress& progress, JointProgress& joint) {
  SphereBranch result;
  auto start = Clock::now();
  result.sphere = conformal_parametrization(mesh, parameters, progress,
                                            [&joint](double fraction) { joint.update(0, "conformal", kConformalShare * fraction); });
  result.seconds.emplace_back("conformal", seconds_since(start));

  start = Clock::now();
  joint.update(0, "centering", kConformalShare);
  Eigen::VectorXd face_mass = face_areas(mesh.vertices, mesh.faces);
  face_mass /= face_mass.sum();
  const FlipRepair repair(mesh);
  Points centered = result.sphere;
  center(centered, mesh.faces, face_mass);
  // On a handful of triangles centering can turn one over; the parametrisation is then left where it is.
  if (repair.repair(centered)) result.sphere = std::move(centered);
  rotate_to_principal_axes(result.sphere, mesh.faces, face_mass);
  if (!repair.repair(result.sphere))
    throw EngineError(ErrorCode::parametrization_failed, "rounding flipped triangles of the spherical parametrisation");
  result.seconds.emplace_back("centering", seconds_since(start));

  start = Clock::now();
  evolve_authalically(result.sphere, mesh, parameters, progress,
                      [&joint](double fraction) { joint.update(0, "authalic", kConformalShare + (1 - kConformalShare) * fraction); });
  result.seconds.emplace_back("authalic", seconds_since(start));
  return result;
}

/// `mesh`: the working mesh at unit area.
std::vector<SignalGrid> signal_grids(const PreprocessedShape& shape, const TriMesh& mesh, const PreprocessParameters& parameters) {
  std::vector<std::string> names;
  for (const double time : parameters.hks_times) names.push_back(hks_name(time));
  for (const std::string& name : selection_signal_names()) names.push_back(name);
  for (const char* name : position_signal_names) names.emplace_back(name);
  names.emplace_back(curvature_signal_name);
  const std::vector<std::string> eigenfunctions = eigenfunction_names(shape.eigenvalues.size());
  names.insert(names.end(), eigenfunctions.begin(), eigenfunctions.end());
  Eigen::MatrixXd signatures(shape.sphere.rows(), static_cast<Eigen::Index>(names.size()));
  signatures << heat_kernel_signatures(shape.eigenvalues, shape.eigenvectors, parameters.hks_times),
      selection_signals(shape.eigenvalues, shape.eigenvectors), mesh.vertices,
      smoothed_mean_curvature(mesh, shape.eigenvalues, shape.eigenvectors, kCurvatureTime),
      shape.eigenvectors.middleCols(1, static_cast<Eigen::Index>(eigenfunctions.size())).cast<double>();
  const std::vector<Grid> grids = rasterize_signals(shape.sphere, mesh.faces, signatures, parameters.signal_resolution);
  std::vector<SignalGrid> result;
  for (std::size_t i = 0; i < grids.size(); ++i) result.push_back({names[i], grids[i].matrix().cast<float>()});
  return result;
}

}  // namespace

std::string_view engine_version() { return "7"; }

Surface read_surface(std::span<const std::byte> bytes, std::string_view name, const ReadOptions& options, const ReadLimits& limits) {
  options.validate();
  Surface surface = repair(read_mesh(bytes, name, limits), options.repair);
  if (options.simplify > 0) surface.decimated = decimate(surface.mesh, options.simplify);
  return surface;
}

PreprocessedShape preprocess(Surface surface, const PreprocessParameters& parameters, const Progress& progress, int threads) {
  parameters.validate();
  const auto start = Clock::now();
  const TriMesh mesh = unit_area(surface.working_mesh());
  PreprocessedShape shape;
  SphereBranch branch;
  FloatEigenbasis basis;
  double eigenbasis_seconds = 0;
  JointProgress joint(progress, 0.6);
  run_parallel(2, threads, [&](std::size_t task) {
    if (task == 0) {
      branch = parametrize(mesh, parameters, progress, joint);
    } else {
      const auto began = Clock::now();
      basis = surface_eigenbasis(mesh, parameters, 1, progress, [&joint](double fraction) { joint.update(1, "eigenbasis", fraction); });
      eigenbasis_seconds = seconds_since(began);
      joint.update(1, "eigenbasis", 1);
    }
  });

  const auto began = Clock::now();
  shape.sphere = std::move(branch.sphere);
  shape.sphere_quality = measure_sphere(shape.sphere, mesh);
  shape.eigenvalues = basis.values;
  shape.eigenvectors = std::move(basis.vectors);
  shape.signals = signal_grids(shape, mesh, parameters);
  const double simplify_seconds = surface.decimated ? surface.decimated->seconds : 0;
  if (surface.decimated) shape.seconds.emplace_back("simplify", simplify_seconds);
  shape.seconds.insert(shape.seconds.end(), branch.seconds.begin(), branch.seconds.end());
  shape.seconds.emplace_back("eigenbasis", eigenbasis_seconds);
  shape.seconds.emplace_back("signals", seconds_since(began));
  shape.seconds.emplace_back("total", simplify_seconds + seconds_since(start));
  shape.surface = std::move(surface);
  shape.engine = std::string(engine_version());
  if (progress.report) progress.report("signals", 1);
  return shape;
}

MatchResult match(const MatchShape& source, const MatchShape& target, const MatchParameters& parameters, const Progress& progress,
                  int threads) {
  parameters.validate();
  MatchResult result = register_pair(source, target, parameters, progress, threads);
  if (&source.shape() == &target.shape() && result.reversed) {
    const InvolutionResidual residual = involution_residual(result.map, source.surface());
    result.quality.emplace_back("involution_mean", residual.mean);
    result.quality.emplace_back("involution_max", residual.max);
  }
  return result;
}

MatchResult match(const PreprocessedShape& source, const PreprocessedShape& target, const MatchParameters& parameters,
                  const Progress& progress, int threads) {
  parameters.validate();
  const auto borrowed = [](const PreprocessedShape& shape) {
    return MatchShape(std::shared_ptr<const PreprocessedShape>(std::shared_ptr<const void>(), &shape));
  };
  return match(borrowed(source), borrowed(target), parameters, progress, threads);
}

Evaluation evaluate(const PreprocessedShape& source, const PreprocessedShape& target, const Correspondence& map,
                    const Correspondence* reverse, const GroundTruth& truth, const Progress& progress, int threads) {
  return evaluate_map(source, target, map, reverse, truth, progress, threads);
}

}  // namespace spherematch
