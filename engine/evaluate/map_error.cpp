#include "engine/evaluate/map_error.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/data/error.h"
#include "engine/evaluate/geodesics.h"
#include "engine/mesh/laplacian.h"

namespace spherematch {

namespace {

void require_index(std::int32_t index, std::size_t count, const char* what) {
  if (index >= 0 && static_cast<std::size_t>(index) < count) return;
  throw EngineError(ErrorCode::invalid_parameter,
                    std::string(what) + ' ' + std::to_string(index) + " is not in 0 to " + std::to_string(count) + " - 1");
}

/// From the image of source vertex `source` to surface vertex `truth`.
double distance(const GeodesicGraph& graph, const Correspondence& map, const Surface& target, std::int32_t source, std::int32_t truth) {
  std::array<std::int32_t, 3> corners{};
  Eigen::RowVector3d image = Eigen::RowVector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const std::int32_t uploaded = map.corners(source, k);
    require_index(uploaded, target.surface_vertex.size(), "a corner of the map,");
    corners[static_cast<std::size_t>(k)] = target.surface_vertex[static_cast<std::size_t>(uploaded)];
    require_index(corners[static_cast<std::size_t>(k)], static_cast<std::size_t>(target.mesh.vertex_count()), "a corner of the map,");
    image += map.bary(source, k) * target.mesh.vertices.row(corners[static_cast<std::size_t>(k)]);
  }
  // Within the faces round the truth the straight line is the geodesic.
  if (std::find(corners.begin(), corners.end(), truth) != corners.end()) return (image - target.mesh.vertices.row(truth)).norm();
  const std::vector<double> to_corners = graph.distances(truth, corners);
  double shortest = to_corners[0] + (image - target.mesh.vertices.row(corners[0])).norm();
  for (std::size_t k = 1; k < 3; ++k) shortest = std::min(shortest, to_corners[k] + (image - target.mesh.vertices.row(corners[k])).norm());
  return shortest;
}

/// The value below which `fraction` of the sorted values lie, between neighbours in proportion.
double quantile(const std::vector<double>& sorted, double fraction) {
  const double place = fraction * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

MapError geodesic_error(const Correspondence& map, const Surface& target, std::span<const Landmark> truth) {
  const GeodesicGraph graph(target.mesh);
  const double unit = std::sqrt(face_areas(target.mesh.vertices, target.mesh.faces).sum());
  MapError result;
  std::vector<double> errors;
  for (const Landmark& landmark : truth) {
    require_index(landmark.source, map.vertex.size(), "the source landmark");
    require_index(landmark.target, target.surface_vertex.size(), "the target landmark");
    const std::int32_t vertex = target.surface_vertex[static_cast<std::size_t>(landmark.target)];
    if (vertex < 0 || map.vertex[static_cast<std::size_t>(landmark.source)] < 0) {
      ++result.unscored;
      continue;
    }
    errors.push_back(distance(graph, map, target, landmark.source, vertex) / unit);
  }
  if (errors.empty()) return result;
  std::sort(errors.begin(), errors.end());
  for (const double error : errors) result.mean += error / static_cast<double>(errors.size());
  result.median = quantile(errors, 0.5);
  result.p95 = quantile(errors, 0.95);
  result.max = errors.back();
  result.scored = static_cast<std::int32_t>(errors.size());
  return result;
}

}  // namespace spherematch
