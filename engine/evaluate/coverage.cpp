#include "engine/evaluate/coverage.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "engine/evaluate/surface_distance.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/laplacian.h"
#include "engine/mesh/topology.h"

namespace spherematch {

namespace {

constexpr double margin = 0.1;  ///< in barycentric weights

/// The flat image of a source face.
class ImageTriangle {
 public:
  explicit ImageTriangle(const std::array<Eigen::Vector3d, 3>& corners) : corners_(corners) {
    normal_ = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    for (std::size_t k = 0; k < 3; ++k) size_ = std::max(size_, (corners[k] - corners[(k + 1) % 3]).norm());
  }

  [[nodiscard]] bool has_area() const { return normal_.squaredNorm() > 0; }

  /// The foot of the perpendicular on the triangle's plane.
  [[nodiscard]] Eigen::Vector3d foot(const Eigen::Vector3d& point) const {
    return point - normal_ * ((point - corners_[0]).dot(normal_) / normal_.squaredNorm());
  }

  /// Whether a point of the plane is in the triangle or a little beside it.
  [[nodiscard]] bool contains(const Eigen::Vector3d& foot) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d &a = corners_[(k + 1) % 3], &b = corners_[(k + 2) % 3];
      if ((a - foot).cross(b - foot).dot(normal_) < -margin * normal_.squaredNorm()) return false;
    }
    return true;
  }

  /// Whether a face with this centre, reaching so far from it, may lie over the triangle.
  [[nodiscard]] bool is_near(const Eigen::Vector3d& centre, const Eigen::Vector3d& foot, double reach) const {
    if ((centre - foot).norm() > reach + size_ / 2) return false;
    if (contains(foot)) return true;
    const std::array<double, 3> weights = nearest_weights(corners_, foot);
    const Eigen::Vector3d nearest = weights[0] * corners_[0] + weights[1] * corners_[1] + weights[2] * corners_[2];
    return (nearest - foot).norm() <= reach;
  }

 private:
  std::array<Eigen::Vector3d, 3> corners_;
  Eigen::Vector3d normal_;  ///< as long as twice the area
  double size_ = 0;         ///< longest edge
};

/// The faces of the target, and which of them are covered so far.
class CoveredFaces {
 public:
  explicit CoveredFaces(const Surface& target)
      : target_(target),
        neighbours_(face_neighbours(target.mesh.faces)),
        round_vertex_(vertex_faces(target.mesh.faces, target.mesh.vertex_count())),
        covered_(static_cast<std::size_t>(target.mesh.face_count()), false),
        visited_(covered_.size(), 0) {
    for (const auto& face : target.mesh.faces.rowwise()) {
      const Eigen::RowVector3d a = vertex(face[0]), b = vertex(face[1]), c = vertex(face[2]);
      const Eigen::RowVector3d centre = (a + b + c) / 3;
      centres_.push_back(centre.transpose());
      reach_.push_back(std::max({(a - centre).norm(), (b - centre).norm(), (c - centre).norm()}));
    }
  }

  /// Covers what lies over the image, going from face to face from its corners.
  void cover(const std::array<const PlacedPoint*, 3>& image) {
    const ImageTriangle triangle({image[0]->position.transpose(), image[1]->position.transpose(), image[2]->position.transpose()});
    if (!triangle.has_area()) return;
    ++round_;
    for (const PlacedPoint* point : image) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (point->weights[k] > 0) {
          for (const std::int32_t face : round_vertex_.of(point->corners[k])) visit(face);
        }
      }
    }
    while (!open_.empty()) {
      const std::int32_t face = open_.back();
      open_.pop_back();
      const auto f = static_cast<std::size_t>(face);
      const Eigen::Vector3d foot = triangle.foot(centres_[f]);
      if (!triangle.is_near(centres_[f], foot, reach_[f])) continue;
      if (triangle.contains(foot)) covered_[f] = true;
      for (const std::int32_t next : neighbours_.row(face))
        if (next >= 0) visit(next);
    }
  }

  /// Of the uploaded area.
  [[nodiscard]] double share() const {
    const Eigen::VectorXd areas = face_areas(target_.mesh.vertices, target_.mesh.faces);
    double sum = 0, reached = 0;
    for (Eigen::Index f = 0; f < areas.size(); ++f) {
      if (target_.uploaded_corners.row(f).minCoeff() < 0) continue;
      sum += areas[f];
      if (covered_[static_cast<std::size_t>(f)]) reached += areas[f];
    }
    return sum > 0 ? reached / sum : 0;
  }

 private:
  [[nodiscard]] Eigen::RowVector3d vertex(std::int32_t index) const { return target_.mesh.vertices.row(index); }

  void visit(std::int32_t face) {
    auto& seen = visited_[static_cast<std::size_t>(face)];
    if (seen == round_) return;
    seen = round_;
    open_.push_back(face);
  }

  const Surface& target_;
  const Triangles neighbours_;
  const VertexFaces round_vertex_;
  std::vector<Eigen::Vector3d> centres_;
  std::vector<double> reach_;  ///< of a face from its centre
  std::vector<bool> covered_;
  std::vector<std::int64_t> visited_;  ///< the round in which a face was seen last
  std::int64_t round_ = 0;
  std::vector<std::int32_t> open_;
};

double vertex_share(const Correspondence& map, const Surface& target) {
  std::vector<bool> reached(target.surface_vertex.size(), false);
  for (const std::int32_t vertex : map.vertex)
    if (vertex >= 0 && static_cast<std::size_t>(vertex) < reached.size()) reached[static_cast<std::size_t>(vertex)] = true;
  return static_cast<double>(std::count(reached.begin(), reached.end(), true)) / static_cast<double>(reached.size());
}

}  // namespace

Coverage measure_coverage(const Correspondence& map, const Surface& source, const Surface& target, const Progress& progress) {
  require_rows(map, source);
  const auto images = images_of(map, target);
  CoveredFaces faces(target);
  for (Eigen::Index f = 0; f < source.mesh.face_count(); ++f) {
    if (f % 1024 == 0) progress.check();
    const auto corners = source.uploaded_corners.row(f);
    if (corners.minCoeff() < 0) continue;
    std::array<const PlacedPoint*, 3> image{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& corner = images[static_cast<std::size_t>(corners[static_cast<Eigen::Index>(k)])];
      image[k] = corner ? &*corner : nullptr;
    }
    if (image[0] != nullptr && image[1] != nullptr && image[2] != nullptr) faces.cover(image);
  }
  return {.area = faces.share(), .vertices = vertex_share(map, target)};
}

}  // namespace spherematch
