// What the tests of the numerical stages share: random numbers that are the same everywhere, spheres, exact spherical harmonics.
//
// Bounds in these tests stand by what was measured: about twice that where discretisation decides, and ten times or more where
// only rounding does, which other flags and compilers change.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "engine/data/tri_mesh.h"
#include "engine/sphere/grid.h"
#include "engine/sphere/harmonics.h"

namespace spherematch::test {

/// The standard library's distributions may differ between implementations; these do not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }
  /// In [low, high).
  double uniform(double low = 0, double high = 1) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  std::int32_t below(std::int32_t count) { return static_cast<std::int32_t>(engine_() % static_cast<std::uint64_t>(count)); }
  Eigen::Vector3d unit_vector() {
    const double z = uniform(-1, 1), longitude = uniform(0, 2 * std::numbers::pi), radius = std::sqrt(1 - z * z);
    return Eigen::Vector3d(radius * std::cos(longitude), radius * std::sin(longitude), z).normalized();
  }
  Eigen::Matrix3d rotation() {
    const Eigen::Vector3d axis = unit_vector();
    return Eigen::AngleAxisd(uniform(0, std::numbers::pi), axis).toRotationMatrix();
  }

 private:
  std::mt19937_64 engine_;
};

inline Points rotated(const Points& points, const Eigen::Matrix3d& rotation) { return points * rotation.transpose(); }

/// Six vertices on the axes; each face covers an octant.
inline TriMesh octahedron() {
  TriMesh mesh;
  mesh.vertices.resize(6, 3);
  mesh.vertices << 1, 0, 0, 0, 1, 0, 0, 0, 1, -1, 0, 0, 0, -1, 0, 0, 0, -1;
  mesh.faces.resize(8, 3);
  mesh.faces << 0, 1, 2, 1, 3, 2, 3, 4, 2, 4, 0, 2, 1, 0, 5, 3, 1, 5, 4, 3, 5, 0, 4, 5;
  return mesh;
}

/// Solid angle of each spherical triangle, (F).
inline Eigen::VectorXd solid_angles(const Points& sphere, const Triangles& faces) {
  Eigen::VectorXd result(faces.rows());
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Eigen::Vector3d a = sphere.row(faces(f, 0)), b = sphere.row(faces(f, 1)), c = sphere.row(faces(f, 2));
    result[f] = 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
  }
  return result;
}

/// The values of a function of the unit vector at the cell centres.
template <typename Function>
Grid sampled(int resolution, const Function& function) {
  Grid grid(resolution, resolution);
  for (int j = 0; j < resolution; ++j)
    for (int i = 0; i < resolution; ++i)
      grid(j, i) = function(sphere_point(std::numbers::pi * (j + 0.5) / resolution, 2 * std::numbers::pi * (i + 0.5) / resolution));
  return grid;
}

/// Y_lm at a unit vector, m >= 0, with the Condon-Shortley phase, by the standard library.
inline std::complex<double> exact_harmonic(int l, int m, const Eigen::Vector3d& p) {
  const double colatitude = std::atan2(std::hypot(p[0], p[1]), p[2]), longitude = std::atan2(p[1], p[0]);
  return std::polar(1.0, m * longitude) * std::sph_legendre(static_cast<unsigned>(l), static_cast<unsigned>(m), colatitude);
}

/// The real function with the given coefficients at a unit vector, summed directly.
inline double exact_sum(int degree, const Harmonics& coefficients, const Eigen::Vector3d& p) {
  double sum = 0;
  for (int m = 0; m <= degree; ++m)
    for (int l = m; l <= degree; ++l)
      sum += (m == 0 ? 1 : 2) * (coefficients[harmonic_index(degree, l, m)] * exact_harmonic(l, m, p)).real();
  return sum;
}

/// Coefficients of a random real function without a mean, all degrees of like strength.
inline Harmonics random_harmonics(int degree, std::uint64_t seed) {
  Random random(seed);
  Harmonics result = Harmonics::Zero(harmonic_count(degree));
  for (int m = 0; m <= degree; ++m)
    for (int l = std::max(m, 1); l <= degree; ++l)
      result[harmonic_index(degree, l, m)] = {random.uniform(-1, 1), m == 0 ? 0.0 : random.uniform(-1, 1)};
  return result;
}

/// A smooth function without symmetry, of degree three and less.
inline double smooth_function(const Eigen::Vector3d& p) {
  const double x = p[0], y = p[1], z = p[2];
  return 0.7 * x + 0.4 * y * z + 0.9 * x * x * z - 0.5 * y * y * y + 0.3 * x * y * z + 0.6 * z * z;
}

/// Its tangential gradient.
inline Eigen::Vector3d smooth_gradient(const Eigen::Vector3d& p) {
  const double x = p[0], y = p[1], z = p[2];
  const Eigen::Vector3d g(0.7 + 1.8 * x * z + 0.3 * y * z, 0.4 * z - 1.5 * y * y + 0.3 * x * z,
                          0.4 * y + 0.9 * x * x + 0.3 * x * y + 1.2 * z);
  return g - g.dot(p) * p;
}

/// The tangent vectors of a field given as Cartesian vectors, at the cell centres.
template <typename Field>
TangentGrid sampled_field(int resolution, const Field& field) {
  TangentGrid result{Grid(resolution, resolution), Grid(resolution, resolution)};
  for (int j = 0; j < resolution; ++j)
    for (int i = 0; i < resolution; ++i) {
      const double colatitude = std::numbers::pi * (j + 0.5) / resolution, longitude = 2 * std::numbers::pi * (i + 0.5) / resolution;
      const Eigen::Vector3d v = field(sphere_point(colatitude, longitude));
      const Eigen::Vector3d south(std::cos(colatitude) * std::cos(longitude), std::cos(colatitude) * std::sin(longitude),
                                  -std::sin(colatitude));
      const Eigen::Vector3d east(-std::sin(longitude), std::cos(longitude), 0);
      result.colatitude(j, i) = v.dot(south);
      result.longitude(j, i) = v.dot(east);
    }
  return result;
}

}  // namespace spherematch::test
