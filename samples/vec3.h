// Points and directions. All arithmetic of the samples is + - * / and sqrt, which IEEE 754 rounds the same way on every
// machine; Eigen is left out because its sums depend on the instruction set.
#pragma once

#include <cmath>

namespace spherematch::samples {

struct Vec3 {
  double x = 0, y = 0, z = 0;

  bool operator==(const Vec3&) const = default;
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vec3& operator+=(Vec3& a, const Vec3& b) { return a = a + b; }

inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline double distance(const Vec3& a, const Vec3& b) { return norm(a - b); }
/// `a` must not be zero.
inline Vec3 normalized(const Vec3& a) { return (1 / norm(a)) * a; }
/// The other side of the creature: x is left (positive) and right, y is up, z is forward.
inline Vec3 mirrored(const Vec3& a) { return {-a.x, a.y, a.z}; }

}  // namespace spherematch::samples
