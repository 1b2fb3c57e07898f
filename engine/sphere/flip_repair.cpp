#include "engine/sphere/flip_repair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/mesh/laplacian.h"
#include "engine/sphere/orientation.h"

namespace spherematch {

FlipRepair::FlipRepair(const Points& surface_vertices, const Triangles& faces)
    : faces_(faces),
      rank_(static_cast<std::size_t>(faces.rows())),
      start_(static_cast<std::size_t>(surface_vertices.rows()) + 1, 0),
      face_(static_cast<std::size_t>(faces.size())) {
  const Eigen::VectorXd areas = face_areas(surface_vertices, faces);
  std::vector<std::int32_t> order(rank_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&areas](std::int32_t f, std::int32_t g) { return areas[f] < areas[g]; });
  for (std::size_t i = 0; i < order.size(); ++i) rank_[static_cast<std::size_t>(order[i])] = static_cast<std::int32_t>(i);

  for (Eigen::Index i = 0; i < faces_.size(); ++i) ++start_[static_cast<std::size_t>(faces_.data()[i]) + 1];
  for (std::size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
  std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
  for (const std::int32_t f : order)
    for (int k = 0; k < 3; ++k) face_[static_cast<std::size_t>(next[static_cast<std::size_t>(faces_(f, k))]++)] = f;
}

bool FlipRepair::repair(Points& sphere) const {
  struct Attempt {
    double thinness;
    int passes;
  };
  constexpr Attempt kAttempts[] = {{0.01, 30}, {0.003, 200}, {0.0005, 400}};
  std::vector<std::int32_t> suspects;
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(faces_.rows()); ++f)
    if (may_be_thin(sphere, f, kAttempts[0].thinness)) suspects.push_back(f);
  if (suspects.empty()) return true;

  std::vector<char> touched(static_cast<std::size_t>(faces_.rows()), 0);
  for (const std::int32_t f : suspects) touched[static_cast<std::size_t>(f)] = 1;
  for (const Attempt& attempt : kAttempts) {
    std::sort(suspects.begin(), suspects.end(),
              [this](std::int32_t f, std::int32_t g) { return rank_[static_cast<std::size_t>(f)] < rank_[static_cast<std::size_t>(g)]; });
    widen_all(sphere, suspects, attempt.thinness, attempt.passes, touched);
    suspects.clear();
    bool flipped = false;
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(faces_.rows()); ++f) {
      if (!touched[static_cast<std::size_t>(f)]) continue;
      suspects.push_back(f);
      flipped = flipped || orientation(corner(sphere, f, 0), corner(sphere, f, 1), corner(sphere, f, 2)) <= 0;
    }
    if (!flipped) return true;
  }
  return false;
}

bool FlipRepair::may_be_thin(const Points& sphere, std::int32_t face, double thinness) const {
  const Eigen::Vector3d a = corner(sphere, face, 0), ab = corner(sphere, face, 1) - a, ac = corner(sphere, face, 2) - a;
  const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
  // The height is at least the volume over the squared length. Far above rounding the volume's sign is beyond doubt.
  return !(a.dot(ab.cross(ac)) > 1.001 * thinness * longest && longest > 1e-20);
}

void FlipRepair::widen_all(Points& sphere, std::vector<std::int32_t> active, double thinness, int max_passes,
                           std::vector<char>& touched) const {
  std::vector<char> queued(touched.size(), 0);
  std::vector<std::int32_t> next;
  for (int pass = 0; pass < max_passes && !active.empty(); ++pass) {
    next.clear();
    for (const std::int32_t f : active) {
      if (!may_be_thin(sphere, f, thinness) || !widen(sphere, f, thinness)) continue;
      for (int k = 0; k < 3; ++k) {
        const auto v = static_cast<std::size_t>(faces_(f, k));
        for (std::int32_t j = start_[v]; j < start_[v + 1]; ++j) {
          const std::int32_t g = face_[static_cast<std::size_t>(j)];
          if (!queued[static_cast<std::size_t>(g)]) next.push_back(g);
          queued[static_cast<std::size_t>(g)] = 1;
        }
      }
    }
    for (const std::int32_t f : next) {
      queued[static_cast<std::size_t>(f)] = 0;
      touched[static_cast<std::size_t>(f)] = 1;
    }
    std::swap(active, next);
  }
}

bool FlipRepair::widen(Points& sphere, std::int32_t face, double thinness) const {
  const Eigen::Vector3d p[3] = {corner(sphere, face, 0), corner(sphere, face, 1), corner(sphere, face, 2)};
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
