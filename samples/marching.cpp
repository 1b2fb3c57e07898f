#include "samples/marching.h"

#include <algorithm>
#include <cstdint>
#include <map>

namespace spherematch::samples {
namespace {

/// The six tetrahedra round the diagonal of a cube; corner bits 1, 2, 4 are steps in x, y, z. All have the same orientation.
constexpr std::array<std::array<int, 4>, 6> tetrahedra{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

class Marcher {
 public:
  Marcher(const Flesh& flesh, double cell, double shift) : cell_(cell) {
    const auto [low, high] = flesh.bounds();
    origin_ = low - (1 + shift) * Vec3{cell, cell, cell};
    const Vec3 extent = high - origin_;
    count_ = {steps(extent.x), steps(extent.y), steps(extent.z)};
    value_.reserve(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]));
    for (std::int64_t k = 0; k < count_[2]; ++k)
      for (std::int64_t j = 0; j < count_[1]; ++j) sample_row(flesh, j, k);
  }

  Mesh run() {
    for (std::int64_t k = 0; k + 1 < count_[2]; ++k)
      for (std::int64_t j = 0; j + 1 < count_[1]; ++j)
        for (std::int64_t i = 0; i + 1 < count_[0]; ++i) cube(i, j, k);
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] std::int64_t steps(double extent) const { return static_cast<std::int64_t>(extent / cell_) + 3; }
  [[nodiscard]] std::int64_t node(std::int64_t i, std::int64_t j, std::int64_t k) const { return (k * count_[1] + j) * count_[0] + i; }
  [[nodiscard]] Vec3 point(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return origin_ + cell_ * Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
  }
  [[nodiscard]] Vec3 point(std::int64_t n) const { return point(n % count_[0], n / count_[0] % count_[1], n / count_[0] / count_[1]); }
  [[nodiscard]] double value(std::int64_t n) const { return value_[static_cast<std::size_t>(n)]; }

  /// A node that no crossed edge can reach needs its sign only, and takes over the value of the node before. Half of a value bounds the
  /// distance to the surface safely; the longest edge is the diagonal of a cube.
  void sample_row(const Flesh& flesh, std::int64_t j, std::int64_t k) {
    constexpr double diagonal = 1.7321;
    for (std::int64_t i = 0; i < count_[0];) {
      const double value = flesh.sample(point(i, j, k)).value;
      const auto skipped = static_cast<std::int64_t>(std::max(0.0, std::abs(value) / (2 * cell_) - diagonal));
      const std::int64_t same_sign = std::min(count_[0] - i, 1 + skipped);
      value_.insert(value_.end(), static_cast<std::size_t>(same_sign), value);
      i += same_sign;
    }
  }

  void cube(std::int64_t i, std::int64_t j, std::int64_t k) {
    std::array<std::int64_t, 8> corner{};
    int inside = 0;
    for (int c = 0; c < 8; ++c) {
      corner[static_cast<std::size_t>(c)] = node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
      inside += value(corner[static_cast<std::size_t>(c)]) < 0 ? 1 : 0;
    }
    if (inside == 0 || inside == 8) return;
    for (const std::array<int, 4>& t : tetrahedra) {
      std::array<std::int64_t, 4> n{};
      for (std::size_t c = 0; c < 4; ++c) n[c] = corner[static_cast<std::size_t>(t[c])];
      tetrahedron(n);
    }
  }

  void tetrahedron(std::array<std::int64_t, 4> n) {
    // Inside corners to the front, by exchanges that are counted: an odd number of them turns the tetrahedron inside out.
    bool odd = false;
    std::size_t inside = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      if (value(n[c]) >= 0) continue;
      if (c != inside) {
        std::swap(n[c], n[inside]);
        odd = !odd;
      }
      ++inside;
    }
    // One statement for each crossing: the vertices are numbered in their order, and that of a call's arguments is the compiler's choice.
    if (inside == 1) {
      const int c = crossing(n[0], n[3]), b = crossing(n[0], n[2]), a = crossing(n[0], n[1]);
      triangle(a, b, c, odd);
    } else if (inside == 3) {
      const int c = crossing(n[2], n[3]), b = crossing(n[1], n[3]), a = crossing(n[0], n[3]);
      triangle(a, b, c, odd);
    } else if (inside == 2) {
      const int a = crossing(n[0], n[2]), b = crossing(n[0], n[3]), c = crossing(n[1], n[3]), d = crossing(n[1], n[2]);
      triangle(a, b, c, odd);
      triangle(a, c, d, odd);
    }
  }

  void triangle(int a, int b, int c, bool reversed) {
    if (reversed) std::swap(b, c);
    mesh_.triangles.push_back({a, b, c});
  }

  /// The vertex where the surface crosses the grid edge from an inside node to an outside one.
  int crossing(std::int64_t inside, std::int64_t outside) {
    const auto [entry, fresh] = vertex_.try_emplace({inside, outside}, static_cast<int>(mesh_.vertices.size()));
    if (fresh) {
      const double t = value(inside) / (value(inside) - value(outside));
      mesh_.vertices.push_back(point(inside) + t * (point(outside) - point(inside)));
    }
    return entry->second;
  }

  double cell_;
  Vec3 origin_;
  std::array<std::int64_t, 3> count_{};
  std::vector<double> value_;
  std::map<std::pair<std::int64_t, std::int64_t>, int> vertex_;
  Mesh mesh_;
};

}  // namespace

Mesh march(const Flesh& flesh, double cell, double shift) { return Marcher(flesh, cell, shift).run(); }

}  // namespace spherematch::samples
