// Rotations without trigonometric functions, and rigid motions as dual quaternions.
#pragma once

#include "samples/vec3.h"

namespace spherematch::samples {

struct Quaternion {
  double w = 1;
  Vec3 v;
};

inline Quaternion operator+(const Quaternion& a, const Quaternion& b) { return {a.w + b.w, a.v + b.v}; }
inline Quaternion operator*(double s, const Quaternion& a) { return {s * a.w, s * a.v}; }
inline Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.w - dot(a.v, b.v), a.w * b.v + b.w * a.v + cross(a.v, b.v)};
}
inline Quaternion conjugate(const Quaternion& a) { return {a.w, -1.0 * a.v}; }
inline double dot(const Quaternion& a, const Quaternion& b) { return a.w * b.w + dot(a.v, b.v); }

/// The unit quaternion that turns by about `degrees` (to 0.3 degrees for |degrees| <= 120) about `axis`, right-handed. The tangent of the
/// half angle is a quotient of polynomials, the same bits everywhere.
inline Quaternion turn(const Vec3& axis, double degrees) {
  constexpr double half_radian = 3.14159265358979323846 / 360;
  const double angle = degrees * half_radian;
  const double squared = angle * angle;
  const double tangent = angle * (15 - squared) / (15 - 6 * squared);
  const Quaternion raw{1, (tangent / norm(axis)) * axis};
  return (1 / std::sqrt(dot(raw, raw))) * raw;
}

/// p -> rotation p + shift
struct RigidMotion {
  Quaternion rotation;  ///< of unit length
  Vec3 shift;

  [[nodiscard]] Vec3 operator()(const Vec3& p) const { return (rotation * Quaternion{0, p} * conjugate(rotation)).v + shift; }
  /// First `b`, then this.
  [[nodiscard]] RigidMotion operator*(const RigidMotion& b) const { return {rotation * b.rotation, (*this)(b.shift)}; }
};

/// A rigid motion in a form whose weighted sums, normalised, are rigid motions again (Kavan et al., "Geometric Skinning with Approximate
/// Dual Quaternion Blending", 2008).
struct DualQuaternion {
  Quaternion real, dual;

  explicit DualQuaternion(const RigidMotion& m) : real(m.rotation), dual(0.5 * (Quaternion{0, m.shift} * m.rotation)) {}
  /// A sum has any length; the motion is that of the normalised one.
  [[nodiscard]] RigidMotion motion() const {
    const double scale = 1 / std::sqrt(dot(real, real));
    const Quaternion r = scale * real;
    return {r, 2 * ((scale * dual) * conjugate(r)).v};
  }
};

}  // namespace spherematch::samples
