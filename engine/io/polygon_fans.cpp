#include "engine/io/polygon_fans.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <span>

namespace spherematch {

namespace {

/// Twice the vector area of a polygon, about its first corner.
Eigen::RowVector3d area_vector(const Points& vertices, std::span<const std::int32_t> face) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  const Eigen::RowVector3d origin = vertices.row(face[0]);
  for (std::size_t i = 1; i + 1 < face.size(); ++i) sum += (vertices.row(face[i]) - origin).cross(vertices.row(face[i + 1]) - origin);
  return sum;
}

/// Large polygons, where trying each corner would take too long, get the fan of their first.
std::size_t fan_apex(const Points& vertices, std::span<const std::int32_t> face) {
  constexpr std::size_t most_tried = 32;
  if (face.size() == 3 || face.size() > most_tried) return 0;
  const Eigen::RowVector3d normal = area_vector(vertices, face);
  const auto corner = [&](std::size_t i) { return vertices.row(face[i % face.size()]); };
  std::size_t best = 0;
  double best_worst = -std::numeric_limits<double>::infinity();
  for (std::size_t apex = 0; apex < face.size(); ++apex) {
    double worst = std::numeric_limits<double>::infinity();
    for (std::size_t i = apex + 1; i + 1 < apex + face.size(); ++i)
      worst = std::min(worst, (corner(i) - corner(apex)).cross(corner(i + 1) - corner(apex)).dot(normal));
    if (worst > best_worst) {
      best_worst = worst;
      best = apex;
    }
  }
  return best;
}

}  // namespace

std::vector<std::uint32_t> fan_triangles(const PolygonMesh& mesh, const Points& positions) {
  std::vector<std::uint32_t> triangles;
  triangles.reserve(mesh.indices.size() * 3);
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const std::size_t apex = fan_apex(positions, face);
    for (std::size_t i = apex + 1; i + 1 < apex + face.size(); ++i) {
      for (const std::size_t corner : {apex, i, i + 1}) triangles.push_back(static_cast<std::uint32_t>(face[corner % face.size()]));
    }
  }
  return triangles;
}

Floats vertex_normals(const PolygonMesh& mesh, const Points& positions) {
  Points sums = Points::Zero(positions.rows(), 3);
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const Eigen::RowVector3d normal = area_vector(positions, face);
    for (const std::int32_t vertex : face) sums.row(vertex) += normal;
  }
  Floats normals(positions.rows(), 3);
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const double length = sums.row(v).stableNorm();
    const Eigen::RowVector3d normal = sums.row(v) / length;
    normals.row(v) = normal.allFinite() ? normal.cast<float>() : Eigen::RowVector3f(0, 0, 1);
  }
  return normals;
}

}  // namespace spherematch
