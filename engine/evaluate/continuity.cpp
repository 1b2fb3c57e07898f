#include "engine/evaluate/continuity.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/evaluate/map_error.h"
#include "engine/evaluate/surface_distance.h"
#include "engine/mesh/laplacian.h"
#include "engine/mesh/topology.h"

namespace spherematch {

namespace {

constexpr double torn_stretch = 5;
constexpr double torn_length = 0.05;  ///< of the unit: short edges stretch by chance

using Images = std::vector<std::optional<PlacedPoint>>;

/// The edges of faces without added corners whose ends have images, each once.
struct EdgeImages {
  std::vector<double> lengths;  ///< on the source
  std::vector<PlacedPoint> begins;
  std::vector<PlacedPoint> ends;
};

bool is_uploaded(const Surface& surface, Eigen::Index face) { return surface.uploaded_corners.row(face).minCoeff() >= 0; }

EdgeImages edge_images(const Images& images, const Surface& source) {
  EdgeImages edges;
  const Triangles neighbours = face_neighbours(source.mesh.faces);
  for (Eigen::Index f = 0; f < source.mesh.face_count(); ++f) {
    if (!is_uploaded(source, f)) continue;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t other = neighbours(f, k);
      if (other > f && is_uploaded(source, other)) continue;  // from the later of its faces
      const int next = (k + 1) % 3;
      const auto& begin = images[static_cast<std::size_t>(source.uploaded_corners(f, k))];
      const auto& end = images[static_cast<std::size_t>(source.uploaded_corners(f, next))];
      const double length =
          (source.mesh.vertices.row(source.mesh.faces(f, k)) - source.mesh.vertices.row(source.mesh.faces(f, next))).norm();
      if (!begin || !end || !(length > 0)) continue;
      edges.lengths.push_back(length);
      edges.begins.push_back(*begin);
      edges.ends.push_back(*end);
    }
  }
  return edges;
}

void measure_edges(Continuity& result, const EdgeImages& edges, const Surface& target, double source_unit, double target_unit,
                   const Progress& progress, int threads) {
  std::vector<double> stretches = geodesic_distances(target, edges.begins, edges.ends, progress, threads);
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const double length = stretches[i] / target_unit;
    stretches[i] = length / (edges.lengths[i] / source_unit);
    if (stretches[i] > torn_stretch && length > torn_length) ++result.torn;
    result.edge_distortion += std::abs(stretches[i] - 1) / static_cast<double>(stretches.size());
  }
  const MapError stretch = summarize(std::move(stretches), 0);
  result.edges = stretch.scored;
  result.stretch_median = stretch.median;
  result.stretch_p95 = stretch.p95;
  result.stretch_max = stretch.max;
}

/// Twice the area of the triangle, along its normal.
Eigen::RowVector3d doubled_area(const Eigen::RowVector3d& a, const Eigen::RowVector3d& b, const Eigen::RowVector3d& c) {
  return (b - a).cross(c - a);
}

/// Twice the Dirichlet energy of the linear map that takes a triangle with these edge lengths, opposite its corners, to another.
double doubled_energy(const Eigen::Vector3d& lengths, double area, const std::array<Eigen::RowVector3d, 3>& images) {
  const ElementMatrix stiffness = stiffness_element(lengths, area);
  double energy = 0;
  for (std::size_t k = 0; k < 3; ++k) energy -= stiffness[3 + k] * (images[(k + 1) % 3] - images[(k + 2) % 3]).squaredNorm();
  return energy;
}

/// The mean of the target's normals at the corners of an image, of any length.
Eigen::RowVector3d normal_at(const PlacedPoint& point, const Points& vertex_normals) {
  Eigen::RowVector3d normal = Eigen::RowVector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) normal += point.weights[k] * vertex_normals.row(point.corners[k]);
  return normal;
}

Points vertex_normals(const TriMesh& mesh) {
  Points normals = Points::Zero(mesh.vertex_count(), 3);
  for (const auto& face : mesh.faces.rowwise()) {
    const auto area = doubled_area(mesh.vertices.row(face[0]), mesh.vertices.row(face[1]), mesh.vertices.row(face[2]));
    for (const std::int32_t corner : face) normals.row(corner) += area;
  }
  normals.rowwise().normalize();
  return normals;
}

void measure_faces(Continuity& result, const Images& images, const Surface& source, const Surface& target, double source_unit,
                   double target_unit) {
  const Points normals = vertex_normals(target.mesh);
  double area_sum = 0, energy = 0, turned = 0;
  for (Eigen::Index f = 0; f < source.mesh.face_count(); ++f) {
    if (!is_uploaded(source, f)) continue;
    std::array<Eigen::RowVector3d, 3> corners, places;
    Eigen::RowVector3d normal = Eigen::RowVector3d::Zero();
    bool complete = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      const auto& image = images[static_cast<std::size_t>(source.uploaded_corners(f, column))];
      complete = complete && image;
      if (!complete) break;
      corners[k] = source.mesh.vertices.row(source.mesh.faces(f, column)) / source_unit;
      places[k] = image->position / target_unit;
      normal += normal_at(*image, normals);
    }
    if (!complete) continue;
    const double area = doubled_area(corners[0], corners[1], corners[2]).norm() / 2;
    if (!(area > 0)) continue;
    const Eigen::Vector3d lengths((corners[1] - corners[2]).norm(), (corners[2] - corners[0]).norm(), (corners[0] - corners[1]).norm());
    area_sum += area;
    energy += doubled_energy(lengths, area, places) / 2;
    if (doubled_area(places[0], places[1], places[2]).dot(normal) < 0) turned += area;
  }
  if (!(area_sum > 0)) return;
  result.dirichlet = energy / area_sum;
  result.turned = std::min(turned, area_sum - turned) / area_sum;
}

}  // namespace

Continuity measure_continuity(const Correspondence& map, const Surface& source, const Surface& target, const Progress& progress,
                              int threads) {
  require_rows(map, source);
  const Images images = images_of(map, target);
  const double source_unit = unit_length(source), target_unit = unit_length(target);
  Continuity result;
  measure_edges(result, edge_images(images, source), target, source_unit, target_unit, progress, threads);
  measure_faces(result, images, source, target, source_unit, target_unit);
  return result;
}

}  // namespace spherematch
