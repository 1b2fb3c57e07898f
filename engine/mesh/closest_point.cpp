#include "engine/mesh/closest_point.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "engine/data/error.h"
#include "engine/mesh/zero_area.h"

namespace spherematch {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using TriangleList = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, TriangleList::const_iterator>;
using AabbTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Eigen::Vector3d to_eigen(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

/// Parameter in [0, 1] of the point of segment ab that is nearest to p.
double nearest_on_segment(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& p) {
  const double length = (b - a).squaredNorm();
  return length > 0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
}

}  // namespace

std::array<double, 3> nearest_weights(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& p) {
  const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double area = normal.squaredNorm();
  std::array<double, 3> weights{};
  if (area > 0) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& b = corners[(k + 1) % 3];
      weights[k] = (corners[(k + 2) % 3] - b).cross(p - b).dot(normal) / area;
    }
    if (weights[0] >= 0 && weights[1] >= 0 && weights[2] >= 0) {
      const double sum = weights[0] + weights[1] + weights[2];
      for (double& weight : weights) weight /= sum;
      return weights;
    }
  }
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d& a = corners[k];
    const Eigen::Vector3d& b = corners[(k + 1) % 3];
    const double t = nearest_on_segment(a, b, p);
    const double distance = (a + t * (b - a) - p).squaredNorm();
    if (distance >= best) continue;
    best = distance;
    weights = {};
    weights[k] = 1 - t;
    weights[(k + 1) % 3] = t;
  }
  return weights;
}

struct ClosestPoint::Tree {
  explicit Tree(const Surface& surface) {
    const Points& vertices = surface.mesh.vertices;
    const auto point = [&](Eigen::Index v) { return Kernel::Point_3(vertices(v, 0), vertices(v, 1), vertices(v, 2)); };
    for (Eigen::Index f = 0; f < surface.mesh.face_count(); ++f) {
      if (surface.uploaded_corners.row(f).minCoeff() < 0) continue;
      const auto corners = surface.mesh.faces.row(f);
      if (is_zero_area(vertices.row(corners(0)), vertices.row(corners(1)), vertices.row(corners(2)))) continue;
      triangles.emplace_back(point(corners(0)), point(corners(1)), point(corners(2)));
      faces.push_back(static_cast<std::int32_t>(f));
    }
    if (faces.empty()) throw EngineError(ErrorCode::degenerate, "no face of positive area was uploaded");
    search.insert(triangles.cbegin(), triangles.cend());
    search.build();
    const std::vector<Hint> hints = distinct_corners();
    search.accelerate_distance_queries(hints.begin(), hints.end());
    // The tree of hints builds itself on first use, which is not left to a query.
    (void)search.closest_point(triangles.front()[0]);
  }

  using Hint = AabbTree::Point_and_primitive_id;

  /// Each place of a corner once. CGAL's own hints are the first corners of the triangles; where many of those coincide, as in a fan,
  /// its recursion over them overflows the stack.
  [[nodiscard]] std::vector<Hint> distinct_corners() const {
    std::vector<Hint> hints;
    for (auto triangle = triangles.cbegin(); triangle != triangles.cend(); ++triangle)
      for (int k = 0; k < 3; ++k) hints.emplace_back((*triangle)[k], triangle);
    std::sort(hints.begin(), hints.end());
    hints.erase(std::unique(hints.begin(), hints.end(), [](const Hint& a, const Hint& b) { return a.first == b.first; }), hints.end());
    return hints;
  }

  TriangleList triangles;
  std::vector<std::int32_t> faces;  ///< of the surface, one per triangle
  AabbTree search;
};

ClosestPoint::ClosestPoint(const Surface& surface) : tree_(std::make_unique<const Tree>(surface)) {}
ClosestPoint::~ClosestPoint() = default;
ClosestPoint::ClosestPoint(ClosestPoint&&) noexcept = default;
ClosestPoint& ClosestPoint::operator=(ClosestPoint&&) noexcept = default;

SurfacePoint ClosestPoint::query(const Eigen::Vector3d& point) const {
  const auto found = tree_->search.closest_point_and_primitive(Kernel::Point_3(point.x(), point.y(), point.z()));
  const auto index = static_cast<std::size_t>(found.second - tree_->triangles.cbegin());
  const Kernel::Triangle_3& triangle = tree_->triangles[index];
  return {tree_->faces[index], nearest_weights({to_eigen(triangle[0]), to_eigen(triangle[1]), to_eigen(triangle[2])}, point)};
}

}  // namespace spherematch
