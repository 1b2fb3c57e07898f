#include "engine/sphere/authalic_evolution.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/mesh/laplacian.h"
#include "engine/mesh/spatial_order.h"
#include "engine/sphere/advection.h"
#include "engine/sphere/density_sampler.h"
#include "engine/sphere/flip_repair.h"
#include "engine/sphere/harmonics.h"
#include "engine/sphere/mobius.h"
#include "engine/sphere/rasterizer.h"

namespace spherematch {
namespace {

constexpr int kCenteringSteps = 3;
constexpr double kMostShortened = 20;
constexpr int kStepsPerRepair = 5;

/// The degree beyond which smoothing leaves less than 1e-6 of a coefficient.
int smoothed_degree(double smoothing, int resolution) {
  const int degree = static_cast<int>(std::sqrt(std::log(1e6) / smoothing));
  return std::clamp(degree, 1, resolution / 2 - 1);
}

/// How long the evolution may follow the field before it must be made anew: further on than the field's features are wide, its paths
/// would cross and fold the surface. That happens only in the beginning, where whole limbs unfold from a point.
double step_size(const TangentGrid& field, const PreprocessParameters& parameters) {
  const double fastest = std::sqrt((field.colatitude.square() + field.longitude.square()).maxCoeff());
  const double size = parameters.authalic_step_size;
  return size / std::clamp(size * fastest / parameters.authalic_longest_move, 1.0, kMostShortened);
}

/// The logarithm of the mass per solid angle that the faces carry, by samples or by the exact rasteriser.
class LogDensity {
 public:
  LogDensity(const Triangles& faces, Eigen::VectorXd face_mass, const PreprocessParameters& parameters)
      : faces_(faces),
        face_mass_(std::move(face_mass)),
        exact_(parameters.exact_rasterization),
        resolution_(parameters.authalic_resolution),
        areas_(cell_areas(resolution_)),
        sampler_(resolution_) {}

  [[nodiscard]] Grid operator()(const Points& sphere) const {
    const double least = 1e-12;  // of the mean: keeps a cell that no triangle reaches finite
    if (!exact_) return sampler_.log_density(sphere, faces_, face_mass_, least);
    const double floor = least / (resolution_ * resolution_);
    return (rasterize_mass(sphere, faces_, face_mass_, resolution_).max(floor).colwise() / areas_).log();
  }

 private:
  const Triangles& faces_;
  Eigen::VectorXd face_mass_;
  bool exact_;
  int resolution_;
  Eigen::ArrayXd areas_;
  DensitySampler sampler_;
};

}  // namespace

void evolve_authalically(Points& original, const TriMesh& surface, const PreprocessParameters& parameters, const Progress& progress,
                         const std::function<void(double)>& report) {
  const std::vector<std::int32_t> order = spatial_order(surface.vertices);
  const TriMesh mesh = renumbered(surface, order);
  const Triangles& faces = mesh.faces;
  Points sphere = original(order, Eigen::all);
  Eigen::VectorXd face_mass = face_areas(mesh.vertices, faces), vertex_mass = vertex_areas(mesh.vertices, faces);
  face_mass /= face_mass.sum();
  vertex_mass /= vertex_mass.sum();
  const int n = parameters.authalic_resolution;
  const int degree = smoothed_degree(parameters.authalic_smoothing, n);
  const HarmonicTransform transform(n, degree);
  const FlipRepair repair(mesh);
  const LogDensity log_density(faces, face_mass, parameters);

  // Coarse limbs cannot follow the flow without flips, since their rings become polygons thinner than their own bend. So every few
  // steps and in the end the state is projected back to where nothing flips. Where that fails a later time mostly mends it; if not, the
  // last good one counts.
  Points last_good = sphere;
  const double end = parameters.authalic_steps * parameters.authalic_step_size;
  bool done = parameters.authalic_steps == 0;
  double time = 0;
  for (int step = 1; !done; ++step) {
    progress.check();
    report(time / end);
    Harmonics smooth = transform.analyze(log_density(sphere));
    scale_degrees(degree, smooth, [&](int l) { return -std::exp(-parameters.authalic_smoothing * l * (l + 1)); });
    const TangentGrid field = transform.synthesize_tangent(smooth, {});
    const double left = end - time, size = step_size(field, parameters);
    done = left < 1.001 * size;  // within rounding of one step
    advect(sphere, TangentField(field), done ? left : size);
    time += size;
    // Steps are short, so that one on the way is as good as three; the last state is centred as exactly as the first.
    centering_step(sphere, vertex_mass);
    for (int i = 0; i < kCenteringSteps && done; ++i) centering_step(sphere, faces, face_mass);
    if ((done || step % kStepsPerRepair == 0) && repair.repair(sphere)) last_good = sphere;
  }
  original(order, Eigen::all) = last_good;
}

}  // namespace spherematch
