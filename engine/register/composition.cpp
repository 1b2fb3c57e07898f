#include "engine/register/composition.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "engine/data/parallel.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/laplacian.h"

namespace spherematch {
namespace {

bool is_uploaded(const Surface& surface, std::int32_t face) { return surface.uploaded_corners.row(face).minCoeff() >= 0; }

Eigen::Vector3d position(const TriMesh& mesh, const Location& location) {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) result += location.bary[k] * mesh.vertices.row(mesh.faces(location.face, k)).transpose();
  return result;
}

/// The corner nearest to the image in straight distance, ties to the lowest index.
std::int32_t nearest_corner(const Surface& target, const Location& location) {
  const Eigen::Vector3d image = position(target.mesh, location);
  std::int32_t best = -1;
  double best_distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double distance = (target.mesh.vertices.row(target.mesh.faces(location.face, k)).transpose() - image).squaredNorm();
    const std::int32_t corner = target.uploaded_corners(location.face, k);
    if (distance < best_distance || (distance == best_distance && corner < best)) {
      best = corner;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace

std::vector<Location> locate_all(const Points& points, const PointLocation& target, int threads) {
  constexpr std::size_t kRun = 4096;
  std::vector<Location> result(static_cast<std::size_t>(points.rows()));
  run_parallel((result.size() + kRun - 1) / kRun, threads, [&](std::size_t run) {
    const std::size_t end = std::min(result.size(), (run + 1) * kRun);
    for (std::size_t i = run * kRun; i < end; ++i) result[i] = target.locate(points.row(static_cast<Eigen::Index>(i)));
  });
  return result;
}

RoundTrip round_trip(const Surface& source, const Surface& target, const std::vector<Location>& there, const std::vector<Location>& back) {
  std::vector<Eigen::Vector3d> returned;
  for (const Location& location : back) returned.push_back(position(source.mesh, location));
  RoundTrip result;
  for (std::size_t i = 0; i < there.size(); ++i) {
    Eigen::Vector3d end = -source.mesh.vertices.row(static_cast<Eigen::Index>(i)).transpose();
    for (int k = 0; k < 3; ++k) end += there[i].bary[k] * returned[static_cast<std::size_t>(target.mesh.faces(there[i].face, k))];
    result.mean += end.norm() / static_cast<double>(there.size());
    result.largest = std::max(result.largest, end.norm());
  }
  const double size = std::sqrt(face_areas(source.mesh.vertices, source.mesh.faces).sum());
  return {result.mean / size, result.largest / size};
}

Correspondence compose(const Surface& source, const Surface& target, const std::vector<Location>& locations) {
  const std::size_t n = source.surface_vertex.size();
  Correspondence map;
  map.vertex.assign(n, -1);
  map.corners.setConstant(static_cast<Eigen::Index>(n), 3, -1);
  map.bary.setZero(static_cast<Eigen::Index>(n), 3);
  std::unique_ptr<const ClosestPoint> closest;  // only for images on patches with added vertices
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t v = source.surface_vertex[i];
    if (v < 0) continue;
    Location location = locations[static_cast<std::size_t>(v)];
    if (!is_uploaded(target, location.face)) {
      if (!closest) closest = std::make_unique<const ClosestPoint>(target);
      const SurfacePoint nearest = closest->query(position(target.mesh, location));
      location = {nearest.face, {nearest.weights[0], nearest.weights[1], nearest.weights[2]}};
    }
    const auto row = static_cast<Eigen::Index>(i);
    map.corners.row(row) = target.uploaded_corners.row(location.face);
    map.bary.row(row) = location.bary.cast<float>().transpose();
    map.vertex[i] = nearest_corner(target, location);
  }
  return map;
}

}  // namespace spherematch
