#include "engine/mesh/polygon_triangulation.h"

#include <Eigen/Geometry>
#include <limits>
#include <utility>

#include "engine/mesh/zero_area.h"

namespace spherematch {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double triangle_cost(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  constexpr double shape_weight = 0.05;
  constexpr double zero_area_penalty = 1e3;
  const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  const double area = 0.5 * (b - a).cross(c - a).norm();
  return area + squares * (is_zero_area(a, b, c) ? zero_area_penalty : shape_weight);
}

/// Upper triangle of the programme: the best cost of the part of the polygon from corner i to corner j, and its apex.
class Table {
 public:
  explicit Table(std::size_t corners) : corners_(corners), cost_(corners * corners, 0.0), apex_(corners * corners, -1) {}
  double& cost(std::int32_t i, std::int32_t j) { return cost_[index(i, j)]; }
  std::int32_t& apex(std::int32_t i, std::int32_t j) { return apex_[index(i, j)]; }

 private:
  [[nodiscard]] std::size_t index(std::int32_t i, std::int32_t j) const {
    return static_cast<std::size_t>(i) * corners_ + static_cast<std::size_t>(j);
  }
  std::size_t corners_;
  std::vector<double> cost_;
  std::vector<std::int32_t> apex_;
};

}  // namespace

std::optional<PolygonTriangles> triangulate_polygon(const std::vector<Eigen::Vector3d>& polygon,
                                                    const std::function<bool(std::int32_t, std::int32_t)>& allowed) {
  const auto n = static_cast<std::int32_t>(polygon.size());
  if (n < 3 || n > most_triangulated_corners) return std::nullopt;
  const auto point = [&](std::int32_t i) -> const Eigen::Vector3d& { return polygon[static_cast<std::size_t>(i)]; };
  Table table(polygon.size());
  for (std::int32_t span = 2; span < n; ++span)
    for (std::int32_t i = 0; i + span < n; ++i) {
      const std::int32_t j = i + span;
      double& best = table.cost(i, j);
      best = infinite;
      if (span < n - 1 && !allowed(i, j)) continue;
      for (std::int32_t k = i + 1; k < j; ++k) {
        const double parts = table.cost(i, k) + table.cost(k, j);
        if (parts >= best) continue;
        const double cost = parts + triangle_cost(point(i), point(k), point(j));
        if (cost >= best) continue;
        best = cost;
        table.apex(i, j) = k;
      }
    }
  if (table.cost(0, n - 1) == infinite) return std::nullopt;

  PolygonTriangles triangles;
  std::vector<std::pair<std::int32_t, std::int32_t>> open{{0, n - 1}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j - i < 2) continue;
    const std::int32_t k = table.apex(i, j);
    triangles.push_back({i, k, j});
    open.emplace_back(k, j);
    open.emplace_back(i, k);
  }
  return triangles;
}

}  // namespace spherematch
