#include "engine/register/point_location.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace spherematch {

PointLocation::PointLocation(const Points& sphere, const Triangles& faces)
    : sphere_(sphere), faces_(faces), order_(static_cast<std::size_t>(faces.rows())) {
  std::vector<Eigen::Array3d> low(order_.size()), high(order_.size());
  for (std::size_t f = 0; f < order_.size(); ++f) {
    const auto i = static_cast<Eigen::Index>(f);
    const Eigen::Array3d a = sphere.row(faces(i, 0)).transpose(), b = sphere.row(faces(i, 1)).transpose(),
                         c = sphere.row(faces(i, 2)).transpose();
    // The spherical triangle bulges out of the flat one by no more than the flat one dips below the sphere.
    const double longest = std::max({(b - a).square().sum(), (c - b).square().sum(), (a - c).square().sum()});
    const double bulge = longest < 2 ? 1 - std::sqrt(1 - longest / 3) + 1e-14 : 2.0;
    low[f] = a.min(b).min(c) - bulge;
    high[f] = a.max(b).max(c) + bulge;
  }
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(order_.size());
  build(0, static_cast<std::int32_t>(order_.size()), low, high);
}

std::int32_t PointLocation::build(std::int32_t begin, std::int32_t end, const std::vector<Eigen::Array3d>& low,
                                  const std::vector<Eigen::Array3d>& high) {
  constexpr std::int32_t kLeaf = 4;
  const auto index = static_cast<std::int32_t>(nodes_.size());
  nodes_.push_back({Eigen::Array3d::Constant(10), Eigen::Array3d::Constant(-10), begin, end - begin});
  Eigen::Array3d center_low = Eigen::Array3d::Constant(10), center_high = Eigen::Array3d::Constant(-10);
  for (std::int32_t i = begin; i < end; ++i) {
    const auto f = static_cast<std::size_t>(order_[static_cast<std::size_t>(i)]);
    Node& node = nodes_.back();
    node.low = node.low.min(low[f]);
    node.high = node.high.max(high[f]);
    center_low = center_low.min(low[f] + high[f]);
    center_high = center_high.max(low[f] + high[f]);
  }
  if (end - begin <= kLeaf) return index;
  Eigen::Index axis = 0;
  (center_high - center_low).maxCoeff(&axis);
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](std::int32_t a, std::int32_t b) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    const double x = low[i][axis] + high[i][axis], y = low[j][axis] + high[j][axis];
    return x < y || (x == y && a < b);
  });
  nodes_[static_cast<std::size_t>(index)].count = 0;
  build(begin, middle, low, high);
  const std::int32_t right = build(middle, end, low, high);
  nodes_[static_cast<std::size_t>(index)].first = right;
  return index;
}

Eigen::Vector3d PointLocation::weights(std::int32_t face, const Eigen::Vector3d& p) const {
  // Differences first: det(p, b, c) of nearly equal vectors would lose everything.
  const Eigen::Vector3d a = sphere_.row(faces_(face, 0)).transpose() - p, b = sphere_.row(faces_(face, 1)).transpose() - p,
                        c = sphere_.row(faces_(face, 2)).transpose() - p;
  return {p.dot(b.cross(c)), p.dot(c.cross(a)), p.dot(a.cross(b))};
}

Location PointLocation::locate(const Eigen::Vector3d& p) const {
  Location best{-1, Eigen::Vector3d::Zero()};
  double best_depth = -std::numeric_limits<double>::infinity();
  const auto visit = [&](double margin) {
    std::int32_t stack[64];
    int size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const std::int32_t index = stack[--size];
      const Node& node = nodes_[static_cast<std::size_t>(index)];
      if ((p.array() < node.low - margin).any() || (p.array() > node.high + margin).any()) continue;
      if (node.count == 0) {
        stack[size++] = node.first;
        stack[size++] = index + 1;
        continue;
      }
      for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
        const std::int32_t f = order_[static_cast<std::size_t>(i)];
        const Eigen::Vector3d w = weights(f, p);
        const double sum = w.sum();
        if (!(sum > 0)) continue;  // flipped, degenerate, or on the far side
        const double depth = w.minCoeff() / sum;
        if (depth > best_depth || (depth == best_depth && f < best.face)) {
          best_depth = depth;
          best = {f, w / sum};
        }
      }
    }
  };
  visit(0);
  for (double margin = 1e-9; best.face < 0 && margin < 4; margin *= 10) visit(margin);
  best.bary = best.bary.cwiseMax(0);
  best.bary /= best.bary.sum();
  return best;
}

}  // namespace spherematch
