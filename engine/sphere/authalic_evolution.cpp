#include "engine/sphere/authalic_evolution.h"

#include <algorithm>
#include <cmath>

#include "engine/mesh/laplacian.h"
#include "engine/sphere/advection.h"
#include "engine/sphere/flip_repair.h"
#include "engine/sphere/harmonics.h"
#include "engine/sphere/mobius.h"
#include "engine/sphere/orientation.h"
#include "engine/sphere/rasterizer.h"

namespace spherematch {
namespace {

constexpr int kCenteringSteps = 3;

/// The degree beyond which smoothing leaves less than 1e-6 of a coefficient.
int smoothed_degree(double smoothing, int resolution) {
  const int degree = static_cast<int>(std::sqrt(std::log(1e6) / smoothing));
  return std::clamp(degree, 1, resolution / 2 - 1);
}

}  // namespace

void evolve_authalically(Points& sphere, const TriMesh& surface, const PreprocessParameters& parameters, const Progress& progress,
                         const std::function<void(double)>& report) {
  const Triangles& faces = surface.faces;
  Eigen::VectorXd face_mass = face_areas(surface.vertices, faces);
  face_mass /= face_mass.sum();
  const int n = parameters.authalic_resolution;
  const int degree = smoothed_degree(parameters.authalic_smoothing, n);
  const HarmonicTransform transform(n, degree);
  const Eigen::ArrayXd areas = cell_areas(n).array();
  const FlipRepair repair(surface);
  const double floor = 1e-12 / (n * n);  // of the total area: keeps a cell that no triangle reaches finite

  // Coarse limbs cannot follow the flow without flips, since their rings become polygons thinner than their own bend. So each
  // step is projected back to where nothing flips. Where that fails a later step mostly mends it; if not, the last good one counts.
  Points last_good = sphere;
  bool good = true;
  for (int step = 0; step < parameters.authalic_steps; ++step) {
    progress.check();
    report(static_cast<double>(step) / parameters.authalic_steps);
    const Grid log_scale = (rasterize_mass(sphere, faces, face_mass, n).max(floor).colwise() / areas).log();
    Harmonics smooth = transform.analyze(log_scale);
    scale_degrees(degree, smooth, [&](int l) { return -std::exp(-parameters.authalic_smoothing * l * (l + 1)); });
    const TangentField velocity(transform.synthesize_tangent(smooth, {}));

    advect(sphere, velocity, parameters.authalic_step_size);
    for (int i = 0; i < kCenteringSteps; ++i) centering_step(sphere, faces, face_mass);
    good = repair.repair(sphere);
    if (good) last_good = sphere;
  }
  if (!good) sphere = last_good;
}

}  // namespace spherematch
