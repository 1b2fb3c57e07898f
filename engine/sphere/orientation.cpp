#include "engine/sphere/orientation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "engine/mesh/laplacian.h"

namespace spherematch {
namespace {

Eigen::Vector3d row(const Points& points, std::int32_t v) { return points.row(v); }

bool is_flipped(const Points& sphere, const Triangles& faces, Eigen::Index f) {
  return orientation(row(sphere, faces(f, 0)), row(sphere, faces(f, 1)), row(sphere, faces(f, 2))) <= 0;
}

}  // namespace

int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  // For vectors no longer than 1.5 the rounding error of this expression stays below 1e-14.
  const double det = a.dot(b.cross(c));
  if (std::abs(det) > 1e-14) return det > 0 ? 1 : -1;
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const Kernel::Vector_3 u(a[0], a[1], a[2]), v(b[0], b[1], b[2]), w(c[0], c[1], c[2]);
  return static_cast<int>(CGAL::orientation(u, v, w));
}

std::vector<std::int32_t> flipped_faces(const Points& sphere, const Triangles& faces) {
  std::vector<std::int32_t> result;
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    if (is_flipped(sphere, faces, f)) result.push_back(static_cast<std::int32_t>(f));
  return result;
}

double total_solid_angle(const Points& sphere, const Triangles& faces) {
  double sum = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Eigen::Vector3d a = row(sphere, faces(f, 0)), b = row(sphere, faces(f, 1)), c = row(sphere, faces(f, 2));
    sum += 2 * std::atan2(a.dot((b - a).cross(c - a)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
  }
  return sum;
}

SphereQuality measure_sphere(const Points& sphere, const TriMesh& surface) {
  const Eigen::VectorXd on_surface = face_areas(surface.vertices, surface.faces), on_sphere = face_areas(sphere, surface.faces);
  const double surface_total = on_surface.sum(), sphere_total = on_sphere.sum();
  SphereQuality quality;
  quality.flipped = static_cast<std::int32_t>(flipped_faces(sphere, surface.faces).size());
  quality.solid_angle_defect = std::abs(total_solid_angle(sphere, surface.faces) - 4 * std::numbers::pi);
  for (Eigen::Index f = 0; f < on_surface.size(); ++f) {
    const double share = on_surface[f] / surface_total;
    if (share > 0 && on_sphere[f] > 0) quality.area_distortion += share * std::abs(std::log(on_sphere[f] / sphere_total / share));
  }
  return quality;
}

}  // namespace spherematch
