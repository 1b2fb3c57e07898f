#include "engine/sphere/advection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace spherematch {

TangentField::TangentField(const TangentGrid& grid) : resolution_(static_cast<int>(grid.colatitude.rows())) {
  const int n = resolution_, stride = n + 2;
  samples_.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(stride));
  const auto at = [&](std::ptrdiff_t row, std::ptrdiff_t column) -> Eigen::Vector4d& {
    return samples_[static_cast<std::size_t>((row + 1) * stride + column + 1)];
  };
  for (int j = 0; j < n; ++j) {
    const double colatitude = std::numbers::pi * (j + 0.5) / n, c = std::cos(colatitude), s = std::sin(colatitude);
    for (int i = 0; i < n; ++i) {
      const double longitude = 2 * std::numbers::pi * (i + 0.5) / n, cl = std::cos(longitude), sl = std::sin(longitude);
      const double u = grid.colatitude(j, i), v = grid.longitude(j, i);
      at(j, i) = {u * c * cl - v * sl, u * c * sl + v * cl, -u * s, 0};
    }
  }
  for (int i = 0; i < n; ++i) {  // beyond a pole lies the opposite meridian
    at(-1, i) = at(0, (i + n / 2) % n);
    at(n, i) = at(n - 1, (i + n / 2) % n);
  }
  for (int j = -1; j <= n; ++j) {
    at(j, -1) = at(j, n - 1);
    at(j, n) = at(j, 0);
  }
}

Eigen::Vector3d TangentField::operator()(const Eigen::Vector3d& p) const {
  const int n = resolution_, stride = n + 2;
  const double colatitude = std::atan2(std::sqrt(p[0] * p[0] + p[1] * p[1]), p[2]);
  double longitude = std::atan2(p[1], p[0]);
  if (longitude < 0) longitude += 2 * std::numbers::pi;
  const double r = colatitude * n / std::numbers::pi + 0.5, c = longitude * n / (2 * std::numbers::pi) + 0.5;
  const int row = std::clamp(static_cast<int>(r), 0, n), column = std::clamp(static_cast<int>(c), 0, n);
  const double fr = r - row, fc = c - column;
  const Eigen::Vector4d* s = samples_.data() + static_cast<std::ptrdiff_t>(row) * stride + column;
  const Eigen::Vector4d v = (1 - fr) * ((1 - fc) * s[0] + fc * s[1]) + fr * ((1 - fc) * s[stride] + fc * s[stride + 1]);
  const Eigen::Vector3d w = v.head<3>();
  return w - w.dot(p) * p;
}

Eigen::Vector3d geodesic_step(const Eigen::Vector3d& p, const Eigen::Vector3d& v) {
  const double length = v.norm();
  if (length < 1e-300) return p;
  return (std::cos(length) * p + std::sin(length) / length * v).normalized();
}

void advect(Points& points, const TangentField& field, double step) {
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::Vector3d p = points.row(i);
    const Eigen::Vector3d start = step * field(p);
    const double length = start.norm();
    if (length < 1e-300) continue;
    const Eigen::Vector3d q = geodesic_step(p, start);
    const Eigen::Vector3d end = step * field(q);
    // Transport along the geodesic turns its own direction and keeps what is normal to it.
    const Eigen::Vector3d direction = start / length, direction_at_end = std::cos(length) * direction - std::sin(length) * p;
    const Eigen::Vector3d back = end + end.dot(direction_at_end) * (direction - direction_at_end);
    Eigen::Vector3d v = 0.5 * (start + back);
    v -= v.dot(p) * p;
    points.row(i) = geodesic_step(p, v);
  }
}

}  // namespace spherematch
