// Where a vector points on the equirectangular grid, without the library's arc tangents: the inner loops of advection and of
// sampled densities ask millions of times.
#pragma once

#include <cmath>
#include <numbers>

namespace spherematch {

/// Arc tangent of t in [0, 1], within 5e-11: a Chebyshev expansion of atan(t) / t in t^2, cut at degree 11 and written in powers.
inline double short_arctangent(double t) {
  const double u = t * t;
  double sum = -0.0006804969070944935;  // written out, since a loop would keep its caller's from working on several numbers at a time
  sum = sum * u + 0.004827225744898897;
  sum = sum * u - 0.016055155748385005;
  sum = sum * u + 0.034133416268105066;
  sum = sum * u - 0.05421530263532077;
  sum = sum * u + 0.07242283819151998;
  sum = sum * u - 0.08979050931097578;
  sum = sum * u + 0.11092984759939989;
  sum = sum * u - 0.14283948417325937;
  sum = sum * u + 0.19999909956717765;
  sum = sum * u - 0.3333333151818752;
  sum = sum * u + 0.9999999999390096;
  return t * sum;
}

/// Fractions of the way from pole to pole, in [0, 1], and round the sphere, in [0, 1].
struct GridPlace {
  double colatitude;
  double longitude;
};

/// Of the direction of (x, y, z), within 2e-11; finite for the zero vector too.
inline GridPlace grid_place(double x, double y, double z) {
  constexpr double kTiny = 1e-300, kHalf = std::numbers::pi / 2;
  const double ax = std::abs(x), ay = std::abs(y), az = std::abs(z), radius = std::sqrt(x * x + y * y);
  const double wide = ax > ay ? ax : ay, narrow = ax > ay ? ay : ax;
  double longitude = short_arctangent(narrow / (wide > kTiny ? wide : kTiny));
  longitude = ay > ax ? kHalf - longitude : longitude;
  longitude = x < 0 ? std::numbers::pi - longitude : longitude;
  longitude = y < 0 ? 2 * std::numbers::pi - longitude : longitude;
  const double high = az > radius ? az : radius, low = az > radius ? radius : az;
  double colatitude = short_arctangent(low / (high > kTiny ? high : kTiny));
  colatitude = radius > az ? kHalf - colatitude : colatitude;
  colatitude = z < 0 ? std::numbers::pi - colatitude : colatitude;
  return {colatitude / std::numbers::pi, longitude / (2 * std::numbers::pi)};
}

}  // namespace spherematch
