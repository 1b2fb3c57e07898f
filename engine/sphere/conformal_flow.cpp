#include "engine/sphere/conformal_flow.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/mesh/laplacian.h"
#include "engine/sphere/flip_repair.h"
#include "engine/sphere/orientation.h"

namespace spherematch {
namespace {

/// Moves the area-weighted centroid to the origin and scales the area to one.
void normalize(Points& x, const Triangles& faces) {
  double area = 0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Eigen::Vector3d a = x.row(faces(f, 0)), b = x.row(faces(f, 1)), c = x.row(faces(f, 2));
    const double w = 0.5 * (b - a).cross(c - a).norm();
    area += w;
    centroid += w / 3 * (a + b + c);
  }
  x.rowwise() -= (centroid / area).transpose();
  x /= std::sqrt(area);
}

/// Linear size of each face on the sphere over its size on the surface, both of total area one.
Eigen::VectorXd conformal_factors(const Points& x, const Triangles& faces, const Eigen::VectorXd& surface_areas) {
  const Eigen::VectorXd areas = face_areas(x.rowwise().normalized(), faces);
  const double tiny = 1e-30;
  return ((areas.array() / areas.sum()).max(tiny) / (surface_areas.array() / surface_areas.sum()).max(tiny)).sqrt();
}

/// The flow with a fixed stiffness.
class ConformalFlow {
 public:
  ConformalFlow(Points& x, const Triangles& faces, const IntrinsicMesh& intrinsic)
      : x_(x),
        faces_(faces),
        intrinsic_(intrinsic),
        areas_(face_areas(intrinsic)),
        pattern_(edge_pattern({&faces, &intrinsic.faces}, x.rows())),
        flowing_(pattern_, faces),
        frozen_(pattern_, intrinsic.faces),
        stiffness_(pattern_),
        mass_(pattern_),
        system_(pattern_) {
    solver_.analyzePattern(pattern_);
  }

  /// `conductivity` (V) scales stiffness and mass around each vertex; `step_size` is the flow's time step.
  void set_stiffness(const Eigen::VectorXd& conductivity, double step_size) {
    const Eigen::VectorXd on_intrinsic = face_means(conductivity, intrinsic_.faces);
    frozen_.assemble(stiffness_, [&](Eigen::Index f) {
      ElementMatrix e = stiffness_element(intrinsic_.lengths.row(f), areas_[f]);
      for (double& entry : e) entry *= step_size * on_intrinsic[f];
      return e;
    });
    density_ = face_means(conductivity, faces_);
  }

  /// False where the system is singular or the flow diverges.
  [[nodiscard]] bool step() {
    const Eigen::VectorXd current = face_areas(x_, faces_);
    flowing_.assemble(mass_, [&](Eigen::Index f) { return mass_element(density_[f] * current[f]); });
    for (Eigen::Index i = 0; i < system_.nonZeros(); ++i) system_.valuePtr()[i] = mass_.valuePtr()[i] + stiffness_.valuePtr()[i];
    solver_.factorize(system_);
    if (solver_.info() != Eigen::Success) return false;
    const Eigen::Matrix<double, Eigen::Dynamic, 3> right = mass_.selfadjointView<Eigen::Lower>() * x_;
    x_ = solver_.solve(right);
    if (!x_.allFinite()) return false;
    normalize(x_, faces_);
    return x_.allFinite();
  }

 private:
  /// Geometric mean over each face's corners.
  static Eigen::VectorXd face_means(const Eigen::VectorXd& values, const Triangles& faces) {
    Eigen::VectorXd means(faces.rows());
    for (Eigen::Index f = 0; f < faces.rows(); ++f) means[f] = std::cbrt(values[faces(f, 0)] * values[faces(f, 1)] * values[faces(f, 2)]);
    return means;
  }

  Points& x_;
  const Triangles& faces_;
  const IntrinsicMesh& intrinsic_;
  Eigen::VectorXd areas_;
  SparseMatrix pattern_;
  ElementAssembler flowing_, frozen_;
  SparseMatrix stiffness_, mass_, system_;
  Eigen::VectorXd density_;  ///< per face of the mesh; scales the mass as the conductivity does the stiffness
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower> solver_;
};

constexpr double kLeastConductivity = 1e-30;  ///< keeps the system regular

/// One run of the method, without a check of the result. Nothing where the flow breaks down.
std::optional<Points> evolve(const TriMesh& surface, const IntrinsicMesh& intrinsic, const PreprocessParameters& parameters,
                             const Progress& progress, const std::function<void(double)>& report) {
  const Triangles& faces = surface.faces;
  Points x = surface.vertices;
  ConformalFlow flow(x, faces, intrinsic);
  Eigen::VectorXd conductivity = Eigen::VectorXd::Ones(x.rows());
  int done = 0;
  const int all = parameters.conformal_steps + parameters.collapse_passes * parameters.collapse_steps;
  const auto run = [&](int steps) -> bool {
    flow.set_stiffness(conductivity, parameters.conformal_step_size);
    for (int step = 0; step < steps; ++step) {
      progress.check();
      if (report) report(static_cast<double>(done++) / all);
      if (!flow.step()) return false;
    }
    return true;
  };
  if (!run(parameters.conformal_steps)) return std::nullopt;

  // A conformal map shrinks a limb exponentially with its length, past what doubles resolve. Lowering the conductivity where it
  // has shrunk most keeps the map harmonic, and free of flips, but makes it shrink less.
  const Eigen::VectorXd surface_areas = face_areas(surface.vertices, faces);
  for (int pass = 0; pass < parameters.collapse_passes; ++pass) {
    const Eigen::VectorXd factors = conformal_factors(x, faces, surface_areas);
    Eigen::VectorXd log_sum = Eigen::VectorXd::Zero(x.rows()), count = log_sum;
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
      for (int k = 0; k < 3; ++k) {
        log_sum[faces(f, k)] += std::log(std::min(1.0, factors[f] / parameters.collapse_threshold));
        count[faces(f, k)] += 1;
      }
    conductivity = (conductivity.array() * (log_sum.array() / count.array()).exp()).max(kLeastConductivity);
    if (!run(parameters.collapse_steps)) return std::nullopt;
  }
  x.rowwise().normalize();
  return x;
}

}  // namespace

Points conformal_parametrization(const TriMesh& surface, const PreprocessParameters& parameters, const Progress& progress,
                                 const std::function<void(double)>& report) {
  TriMesh start = surface;
  normalize(start.vertices, start.faces);
  // The stiffness is that of the intrinsic Delaunay triangulation: without negative weights limbs collapse without folding.
  IntrinsicMesh intrinsic = intrinsic_mesh(start);
  make_delaunay(intrinsic);

  // The discrete flow drifts on meshes of a few triangles, where fewer steps serve, and needs more passes on a needle.
  PreprocessParameters fewer = parameters, more = parameters;
  fewer.conformal_steps = std::min(parameters.conformal_steps, 5);
  fewer.collapse_passes = 0;
  more.collapse_passes = 4 * parameters.collapse_passes;
  const FlipRepair repair(surface);
  const auto is_valid = [&](Points& sphere) {  // upright everywhere is not enough: the sphere could be covered more than once
    return repair.repair(sphere) && std::abs(total_solid_angle(sphere, surface.faces) - 4 * std::numbers::pi) < 1e-6;
  };
  for (const PreprocessParameters& attempt : {parameters, fewer, more}) {
    std::optional<Points> sphere = evolve(start, intrinsic, attempt, progress, report);
    if (sphere && is_valid(*sphere)) return *sphere;
  }
  // Long convex shapes with needle triangles are left: seen from their centre they are a sphere already, if not conformally.
  Points radial = start.vertices.rowwise().normalized();
  if (is_valid(radial)) return radial;
  throw EngineError(
      ErrorCode::parametrization_failed,
      "no spherical parametrisation without flipped triangles was found; parts of the surface may be too thin for their length");
}

}  // namespace spherematch
