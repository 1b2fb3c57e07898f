#include "engine/sphere/advection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace spherematch {

TangentField::TangentField(const TangentGrid& grid) : resolution_(static_cast<int>(grid.colatitude.rows())) {
  const int n = resolution_, stride = n + 2;
  samples_.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(stride));
  const auto at = [&](std::ptrdiff_t row, std::ptrdiff_t column) -> Eigen::Vector4d& {
    return samples_[static_cast<std::size_t>((row + 1) * stride + column + 1)];
  };
  const Eigen::ArrayXd longitudes = 2 * std::numbers::pi / n * (Eigen::ArrayXd::LinSpaced(n, 0, n - 1) + 0.5);
  const Eigen::ArrayXd cosines = longitudes.cos(), sines = longitudes.sin();
  for (int j = 0; j < n; ++j) {
    const double colatitude = std::numbers::pi * (j + 0.5) / n, c = std::cos(colatitude), s = std::sin(colatitude);
    for (int i = 0; i < n; ++i) {
      const double u = grid.colatitude(j, i), v = grid.longitude(j, i);
      at(j, i) = {u * c * cosines[i] - v * sines[i], u * c * sines[i] + v * cosines[i], -u * s, 0};
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

Eigen::Vector3d TangentField::interpolate(const GridPlace& place) const {
  const int n = resolution_, stride = n + 2;
  const double r = place.colatitude * n + 0.5, c = place.longitude * n + 0.5;
  const int row = std::clamp(static_cast<int>(r), 0, n), column = std::clamp(static_cast<int>(c), 0, n);
  const double fr = r - row, fc = c - column;
  const Eigen::Vector4d* s = samples_.data() + static_cast<std::ptrdiff_t>(row) * stride + column;
  const Eigen::Vector4d v = (1 - fr) * ((1 - fc) * s[0] + fc * s[1]) + fr * ((1 - fc) * s[stride] + fc * s[stride + 1]);
  return v.head<3>();
}

Eigen::Vector3d TangentField::operator()(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d v = interpolate(grid_place(p[0], p[1], p[2]));
  return v - v.dot(p) * p;
}

Eigen::Vector3d geodesic_step(const Eigen::Vector3d& p, const Eigen::Vector3d& v) {
  const double length = v.norm();
  if (length < 1e-300) return p;
  return (std::cos(length) * p + std::sin(length) / length * v).normalized();
}

namespace {

constexpr std::size_t kBatch = 64;

/// So many vectors, a coordinate at a time, for loops that work on several at once.
struct Batch {
  std::array<double, kBatch> x, y, z;
};

/// v = step * (field at p), tangent at p.
void look_up(const TangentField& field, double step, const Batch& p, Batch& v) {
  std::array<GridPlace, kBatch> places;
  for (std::size_t i = 0; i < kBatch; ++i) places[i] = grid_place(p.x[i], p.y[i], p.z[i]);
  for (std::size_t i = 0; i < kBatch; ++i) {
    const Eigen::Vector3d w = step * field.interpolate(places[i]);
    v.x[i] = w[0];
    v.y[i] = w[1];
    v.z[i] = w[2];
  }
  for (std::size_t i = 0; i < kBatch; ++i) {
    const double along = v.x[i] * p.x[i] + v.y[i] * p.y[i] + v.z[i] * p.z[i];
    v.x[i] -= along * p.x[i];
    v.y[i] -= along * p.y[i];
    v.z[i] -= along * p.z[i];
  }
}

/// geodesic_step for each. Short ones, which most are, sum the power series of sine and cosine up to the last digit.
void step_all(const Batch& p, const Batch& v, Batch& q) {
  constexpr double kShort = 0.0625;  // squared length
  double longest = 0;
  for (std::size_t i = 0; i < kBatch; ++i) {
    const double s = v.x[i] * v.x[i] + v.y[i] * v.y[i] + v.z[i] * v.z[i];
    longest = s > longest ? s : longest;
    const double cosine = 1 - s / 2 * (1 - s / 12 * (1 - s / 30 * (1 - s / 56 * (1 - s / 90))));
    const double sine = 1 - s / 6 * (1 - s / 20 * (1 - s / 42 * (1 - s / 72 * (1 - s / 110))));  // over the length
    const double x = cosine * p.x[i] + sine * v.x[i], y = cosine * p.y[i] + sine * v.y[i], z = cosine * p.z[i] + sine * v.z[i];
    const double scale = s > 0 ? 1 / std::sqrt(x * x + y * y + z * z) : 1;
    q.x[i] = scale * x;
    q.y[i] = scale * y;
    q.z[i] = scale * z;
  }
  for (std::size_t i = 0; i < kBatch && longest > kShort; ++i) {
    const Eigen::Vector3d end = geodesic_step({p.x[i], p.y[i], p.z[i]}, {v.x[i], v.y[i], v.z[i]});
    q.x[i] = end[0];
    q.y[i] = end[1];
    q.z[i] = end[2];
  }
}

/// The mean of `start` and `end`, the latter carried from q back to p: that turns the plane of both and keeps what is normal to it.
void average(const Batch& p, const Batch& q, const Batch& start, const Batch& end, Batch& v) {
  for (std::size_t i = 0; i < kBatch; ++i) {
    const double across = end.x[i] * p.x[i] + end.y[i] * p.y[i] + end.z[i] * p.z[i];
    const double turn = across / (1 + p.x[i] * q.x[i] + p.y[i] * q.y[i] + p.z[i] * q.z[i]);
    v.x[i] = 0.5 * (start.x[i] + end.x[i] - turn * (p.x[i] + q.x[i]));
    v.y[i] = 0.5 * (start.y[i] + end.y[i] - turn * (p.y[i] + q.y[i]));
    v.z[i] = 0.5 * (start.z[i] + end.z[i] - turn * (p.z[i] + q.z[i]));
  }
}

}  // namespace

void advect(Points& points, const TangentField& field, double step) {
  constexpr auto size = static_cast<Eigen::Index>(kBatch);
  Batch p, q, start, end, v;
  for (Eigen::Index first = 0; first < points.rows(); first += size) {
    const Eigen::Index count = std::min(size, points.rows() - first);
    for (Eigen::Index i = 0; i < size; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Eigen::Index row = first + std::min(i, count - 1);  // the last batch repeats the last point
      p.x[k] = points(row, 0);
      p.y[k] = points(row, 1);
      p.z[k] = points(row, 2);
    }
    look_up(field, step, p, start);
    step_all(p, start, q);
    look_up(field, step, q, end);
    average(p, q, start, end, v);
    step_all(p, v, q);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      points.row(first + i) << q.x[k], q.y[k], q.z[k];
    }
  }
}

}  // namespace spherematch
