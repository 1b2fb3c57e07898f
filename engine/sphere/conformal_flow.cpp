#include "engine/sphere/conformal_flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "engine/mesh/coarsen.h"
#include "engine/mesh/laplacian.h"
#include "engine/sphere/flip_repair.h"
#include "engine/sphere/flow_solver.h"
#include "engine/sphere/orientation.h"

namespace spherematch {
namespace {

constexpr double kLeastConductivity = 1e-30;  ///< keeps the system regular
constexpr int kLeastSteps = 3;                ///< of a pass: its first ones move little yet

/// Linear size of each face on the sphere over its size on the surface, both of total area one.
Eigen::VectorXd conformal_factors(const Points& x, const Triangles& faces, const Eigen::VectorXd& surface_areas) {
  const Eigen::VectorXd areas = face_areas(x.rowwise().normalized(), faces);
  const double tiny = 1e-30;
  return ((areas.array() / areas.sum()).max(tiny) / (surface_areas.array() / surface_areas.sum()).max(tiny)).sqrt();
}

/// A surface of unit area about the origin with the triangulation that its stiffness is taken from.
struct Body {
  TriMesh mesh;
  IntrinsicMesh intrinsic;

  explicit Body(const TriMesh& surface) : mesh(surface) {
    normalize(mesh.vertices, mesh.faces);
    // That of the intrinsic Delaunay triangulation: without negative weights limbs collapse without folding.
    intrinsic = intrinsic_mesh(mesh);
    make_delaunay(intrinsic);
  }
};

/// Where the flow has arrived: points about the unit sphere and the conductivity at the vertices.
struct FlowState {
  Points x;
  Eigen::VectorXd conductivity;
};

/// Lowers the conductivity where the map has shrunk most.
void reweight(FlowState& state, const TriMesh& mesh, double threshold) {
  const Eigen::VectorXd factors = conformal_factors(state.x, mesh.faces, face_areas(mesh.vertices, mesh.faces));
  Eigen::VectorXd log_sum = Eigen::VectorXd::Zero(state.x.rows()), count = log_sum;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      log_sum[mesh.faces(f, k)] += std::log(std::min(1.0, factors[f] / threshold));
      count[mesh.faces(f, k)] += 1;
    }
  state.conductivity = (state.conductivity.array() * (log_sum.array() / count.array()).exp()).max(kLeastConductivity);
}

/// One run of the method, without a check of the result. Nothing where the flow breaks down.
std::optional<FlowState> evolve(const Body& body, const PreprocessParameters& parameters, const Progress& progress,
                                const std::function<void(double)>& report) {
  FlowState state{body.mesh.vertices, Eigen::VectorXd::Ones(body.mesh.vertex_count())};
  FlowSolver solver(state.x, body.mesh.faces, body.intrinsic);
  const int all = parameters.conformal_steps + parameters.collapse_passes * parameters.collapse_steps;
  int before = 0;
  const auto run = [&](int steps) -> bool {
    solver.set_stiffness(state.conductivity, parameters.conformal_step_size);
    for (int step = 0; step < steps; ++step) {
      progress.check();
      if (report) report(static_cast<double>(before + step) / all);
      if (!solver.step()) return false;
      if (step + 1 >= kLeastSteps && solver.last_move() < parameters.conformal_tolerance) break;
    }
    before += steps;
    return true;
  };
  if (!run(parameters.conformal_steps)) return std::nullopt;
  // A conformal map shrinks a limb exponentially with its length, past what doubles resolve. Lowering the conductivity where it
  // has shrunk most keeps the map harmonic, and free of flips, but makes it shrink less.
  for (int pass = 0; pass < parameters.collapse_passes; ++pass) {
    reweight(state, body.mesh, parameters.collapse_threshold);
    if (!run(parameters.collapse_steps)) return std::nullopt;
  }
  return state;
}

/// The state of a coarse copy at the vertices of the surface; the logarithm of the conductivity is what varies evenly.
FlowState interpolated(const CoarseMesh& coarse, const FlowState& state) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> weights = interpolation(coarse);
  const Points sphere = state.x.rowwise().normalized();
  const Eigen::VectorXd logarithms = state.conductivity.array().log();
  return {weights * sphere, (weights * logarithms).array().exp()};
}

/// The flow of a coarse copy, carried to the surface and smoothed there: a step divides a mode of eigenvalue l by 1 + l times its size, so
/// that a few leave nothing of how the copy was triangulated. Nothing where there is no copy, or a flow breaks down.
std::optional<FlowState> evolve_from_coarse(const Body& body, const PreprocessParameters& parameters, const Progress& progress,
                                            const std::function<void(double)>& report) {
  constexpr double kCoarseShare = 0.5;  // of the time
  const std::optional<CoarseMesh> coarse = coarsen(body.mesh, parameters.conformal_coarse_vertices, progress);
  if (!coarse) return std::nullopt;
  const auto report_coarse = [&](double fraction) {
    if (report) report(kCoarseShare * fraction);
  };
  const std::optional<FlowState> start = evolve(Body(coarse->mesh), parameters, progress, report_coarse);
  if (!start) return std::nullopt;
  progress.check();
  FlowState state = interpolated(*coarse, *start);
  normalize(state.x, body.mesh.faces);
  FlowSolver solver(state.x, body.mesh.faces, body.intrinsic);
  solver.set_stiffness(state.conductivity, parameters.conformal_step_size);
  for (int step = 0; step < parameters.conformal_fine_steps; ++step) {
    progress.check();
    if (report) report(kCoarseShare + (1 - kCoarseShare) * (step + 1) / (parameters.conformal_fine_steps + 1));
    if (!solver.step()) return std::nullopt;
  }
  return state;
}

}  // namespace

Points conformal_parametrization(const TriMesh& surface, const PreprocessParameters& parameters, const Progress& progress,
                                 const std::function<void(double)>& report) {
  const Body body(surface);
  const FlipRepair repair(surface);
  const auto is_valid = [&](Points& sphere) {  // upright everywhere is not enough: the sphere could be covered more than once
    sphere.rowwise().normalize();
    return repair.repair(sphere) && std::abs(total_solid_angle(sphere, surface.faces) - 4 * std::numbers::pi) < 1e-6;
  };
  constexpr double kWorthwhile = 1.5;  // times as many vertices
  const bool large = parameters.conformal_coarse_vertices > 0 &&
                     static_cast<double>(surface.vertex_count()) > kWorthwhile * parameters.conformal_coarse_vertices;
  if (large) {
    std::optional<FlowState> state = evolve_from_coarse(body, parameters, progress, report);
    if (state && is_valid(state->x)) return state->x;
  }

  // A needle needs more passes. On meshes of a few triangles the discrete flow drifts and fewer steps serve, if with more distortion.
  PreprocessParameters fewer = parameters, more = parameters;
  more.collapse_passes = 4 * parameters.collapse_passes;
  fewer.conformal_steps = std::min(parameters.conformal_steps, 5);
  fewer.collapse_passes = 0;
  for (const PreprocessParameters& attempt : {parameters, more, fewer}) {
    std::optional<FlowState> state = evolve(body, attempt, progress, report);
    if (state && is_valid(state->x)) return state->x;
  }
  // Long convex shapes with needle triangles are left: seen from their centre they are a sphere already, if not conformally.
  Points radial = body.mesh.vertices;
  if (is_valid(radial)) return radial;
  throw EngineError(
      ErrorCode::parametrization_failed,
      "no spherical parametrisation without flipped triangles was found; parts of the surface may be too thin for their length");
}

}  // namespace spherematch
