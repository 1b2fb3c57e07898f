#include "engine/sphere/flip_repair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/mesh/laplacian.h"
#include "engine/sphere/orientation.h"

namespace spherematch {

FlipRepair::FlipRepair(const Points& surface_vertices, const Triangles& faces)
    : faces_(faces.rows(), 3),
      start_(static_cast<std::size_t>(surface_vertices.rows()) + 1, 0),
      face_(static_cast<std::size_t>(faces.size())) {
  const Eigen::VectorXd areas = face_areas(surface_vertices, faces);
  std::vector<std::int32_t> order(static_cast<std::size_t>(faces.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&areas](std::int32_t f, std::int32_t g) { return areas[f] < areas[g]; });
  for (std::size_t f = 0; f < order.size(); ++f) faces_.row(static_cast<Eigen::Index>(f)) = faces.row(order[f]);

  for (Eigen::Index i = 0; i < faces_.size(); ++i) ++start_[static_cast<std::size_t>(faces_.data()[i]) + 1];
  for (std::size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
  std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
  for (Eigen::Index f = 0; f < faces_.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      face_[static_cast<std::size_t>(next[static_cast<std::size_t>(faces_(f, k))]++)] = static_cast<std::int32_t>(f);
}

bool FlipRepair::repair(Points& sphere) const {
  struct Attempt {
    double thinness;
    int passes;
  };
  for (const Attempt& attempt : {Attempt{0.01, 30}, Attempt{0.003, 200}, Attempt{0.0005, 400}}) {
    widen_all(sphere, attempt.thinness, attempt.passes);
    if (flipped_faces(sphere, faces_).empty()) return true;
  }
  return false;
}

void FlipRepair::widen_all(Points& sphere, double thinness, int max_passes) const {
  std::vector<std::int32_t> active(static_cast<std::size_t>(faces_.rows()));
  std::iota(active.begin(), active.end(), 0);
  std::vector<char> queued(active.size(), 0);
  for (int pass = 0; pass < max_passes && !active.empty(); ++pass) {
    std::vector<std::int32_t> next;
    for (const std::int32_t f : active) {
      if (!widen(sphere, f, thinness)) continue;
      for (int k = 0; k < 3; ++k) {
        const auto v = static_cast<std::size_t>(faces_(f, k));
        for (std::int32_t j = start_[v]; j < start_[v + 1]; ++j) {
          const std::int32_t g = face_[static_cast<std::size_t>(j)];
          if (!queued[static_cast<std::size_t>(g)]) next.push_back(g);
          queued[static_cast<std::size_t>(g)] = 1;
        }
      }
    }
    for (const std::int32_t f : next) queued[static_cast<std::size_t>(f)] = 0;
    active = std::move(next);
  }
}

bool FlipRepair::widen(Points& sphere, std::int32_t face, double thinness) const {
  Eigen::Vector3d p[3];
  for (int k = 0; k < 3; ++k) p[k] = sphere.row(faces_(face, k));
  int top = 0;  // opposite the longest edge
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    const double length = (p[(k + 2) % 3] - p[(k + 1) % 3]).squaredNorm();
    if (length > longest) {
      longest = length;
      top = k;
    }
  }
  const Eigen::Vector3d a = p[top], b = p[(top + 1) % 3], c = p[(top + 2) % 3];
  const Eigen::Vector3d edge = c - b, across = b.cross(edge);
  const double length = std::sqrt(longest), size = across.norm();
  if (!(size > 0)) return false;
  const Eigen::Vector3d normal = across / size;
  const double missing = thinness * length - (a - b).dot(normal);
  if (!(missing > 0)) return false;
  const double s = std::clamp((a - b).dot(edge) / longest, 0.0, 1.0);
  const double share = missing / (1 + (1 - s) * (1 - s) + s * s);
  sphere.row(faces_(face, top)) = (a + share * normal).normalized();
  sphere.row(faces_(face, (top + 1) % 3)) = (b - (1 - s) * share * normal).normalized();
  sphere.row(faces_(face, (top + 2) % 3)) = (c - s * share * normal).normalized();
  return true;
}

}  // namespace spherematch
