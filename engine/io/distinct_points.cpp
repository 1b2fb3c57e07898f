#include "engine/io/distinct_points.h"

#include <algorithm>
#include <bit>
#include <random>

namespace spherematch {

DistinctPoints::DistinctPoints() : first_(1024, -1) {
  std::random_device random;
  for (std::uint64_t& word : key_) word = (std::uint64_t{random()} << 32) | random();
}

/// Multilinear hashing of 32-bit words by 64-bit keys, of which the high half is strongly universal: two different points collide
/// with the probability of one over the number of buckets. D. Lemire and O. Kaser, "Strongly universal string hashing is fast" (2014).
std::size_t DistinctPoints::hash(const std::array<double, 3>& point) const {
  std::uint64_t sum = key_[6];
  for (std::size_t k = 0; k < 3; ++k) {
    const auto bits = std::bit_cast<std::uint64_t>(point[k] + 0.0);  // -0 becomes 0
    sum += key_[2 * k] * (bits & 0xFFFFFFFF) + key_[2 * k + 1] * (bits >> 32);
  }
  return static_cast<std::size_t>(sum >> 32) & (first_.size() - 1);
}

std::int32_t DistinctPoints::number_of(const std::array<double, 3>& point) {
  std::size_t bucket = hash(point);
  for (std::int32_t i = first_[bucket]; i >= 0; i = next_[static_cast<std::size_t>(i)])
    if (points_[static_cast<std::size_t>(i)] == point) return i;
  if (points_.size() == first_.size()) {
    grow();
    bucket = hash(point);
  }
  const auto number = static_cast<std::int32_t>(points_.size());
  points_.push_back(point);
  next_.push_back(first_[bucket]);
  first_[bucket] = number;
  return number;
}

void DistinctPoints::grow() {
  first_.assign(2 * first_.size(), -1);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    std::int32_t& first = first_[hash(points_[i])];
    next_[i] = first;
    first = static_cast<std::int32_t>(i);
  }
}

Points DistinctPoints::points() const {
  Points points(static_cast<Eigen::Index>(points_.size()), 3);
  for (std::size_t i = 0; i < points_.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) points(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = points_[i][k];
  return points;
}

}  // namespace spherematch
