#include "engine/mesh/intrinsic_delaunay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

namespace spherematch {
namespace {

/// Area from lengths, stable for needles (Kahan).
double triangle_area(double a, double b, double c) {
  if (a < b) std::swap(a, b);
  if (a < c) std::swap(a, c);
  if (b < c) std::swap(b, c);
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return 0.25 * std::sqrt(std::max(product, 0.0));
}

/// One side of an edge: the edge opposite corner `corner` of `face`.
struct Side {
  std::int32_t face = -1;
  std::int32_t corner = 0;
};

class DelaunayFlipper {
 public:
  explicit DelaunayFlipper(IntrinsicMesh& mesh) : mesh_(mesh), twins_(static_cast<std::size_t>(mesh.faces.rows())) { pair_sides(); }

  void run() {
    std::vector<Side> stack;
    const auto count = static_cast<std::int32_t>(mesh_.faces.rows());
    for (std::int32_t f = count - 1; f >= 0; --f)
      for (std::int32_t k = 0; k < 3; ++k) stack.push_back({f, k});
    // The flips end in exact arithmetic; the bound guards against rounding on nearly cocircular quadrilaterals.
    std::int64_t budget = 200LL * count;
    while (!stack.empty() && budget-- > 0) {
      const Side side = stack.back();
      stack.pop_back();
      const std::int32_t f = side.face, g = twin(side).face;
      if (!flip(side)) continue;
      for (std::int32_t k = 0; k < 3; ++k) {
        stack.push_back({f, k});
        stack.push_back({g, k});
      }
    }
  }

 private:
  Side& twin(Side s) { return twins_[static_cast<std::size_t>(s.face)][static_cast<std::size_t>(s.corner)]; }
  double& length(Side s) { return mesh_.lengths(s.face, s.corner); }
  std::int32_t& vertex(Side s) { return mesh_.faces(s.face, s.corner); }
  static Side next(Side s) { return {s.face, (s.corner + 1) % 3}; }
  static Side previous(Side s) { return {s.face, (s.corner + 2) % 3}; }

  void pair_sides() {
    struct Edge {
      std::int32_t low, high;
      Side side;
    };
    std::vector<Edge> edges;
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(mesh_.faces.rows()); ++f)
      for (std::int32_t k = 0; k < 3; ++k) {
        const std::int32_t p = mesh_.faces(f, (k + 1) % 3), q = mesh_.faces(f, (k + 2) % 3);
        edges.push_back({std::min(p, q), std::max(p, q), {f, k}});
      }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
      return std::tie(a.low, a.high, a.side.face, a.side.corner) < std::tie(b.low, b.high, b.side.face, b.side.corner);
    });
    for (std::size_t i = 0; i + 1 < edges.size(); i += 2) {
      twin(edges[i].side) = edges[i + 1].side;
      twin(edges[i + 1].side) = edges[i].side;
    }
  }

  /// Cotangent of the angle opposite the side.
  double cotangent(Side s) {
    const double l = length(s), m = length(next(s)), n = length(previous(s));
    const double area = triangle_area(l, m, n);
    return area > 0 ? (m * m + n * n - l * l) / (4 * area) : (m * m + n * n > l * l ? 1e300 : -1e300);
  }

  /// Replaces the edge by the other diagonal of its two triangles when that is Delaunay. The faces keep their names: with corners
  /// (a; b, c) and (d; c, b) before, they are (a; b, d) at `side` and (d; c, a) at its twin after, sides opposite b and c changed.
  bool flip(Side side) {
    const Side other = twin(side);
    if (other.face == side.face || cotangent(side) + cotangent(other) >= -1e-9) return false;
    const std::int32_t a = vertex(side), d = vertex(other);
    if (a == d) return false;

    // Lay out b at the origin and c on the axis; a above, d below.
    const double bc = length(side), ac = length(next(side)), ab = length(previous(side));
    const double bd = length(next(other)), cd = length(previous(other));
    const double ax = (ab * ab + bc * bc - ac * ac) / (2 * bc), dx = (bd * bd + bc * bc - cd * cd) / (2 * bc);
    const double ay = 2 * triangle_area(ab, bc, ac) / bc, dy = 2 * triangle_area(bd, bc, cd) / bc;
    const double ad = std::hypot(ax - dx, ay + dy);
    if (!(ad < ab + bd && ad < ac + cd)) return false;  // no strict triangle after rounding

    const std::int32_t b = vertex(next(side)), c = vertex(previous(side));
    const Side twin_ab = twin(previous(side)), twin_ac = twin(next(side)), twin_bd = twin(next(other)), twin_cd = twin(previous(other));
    const std::int32_t f = side.face, g = other.face;
    for (const Side outer : {twin_ab, twin_ac, twin_bd, twin_cd})
      if (outer.face == f || outer.face == g) return false;  // a vertex of degree two: the quadrilateral borders on itself
    set_face(f, {a, b, d}, {bd, ad, ab});
    set_face(g, {d, c, a}, {ac, ad, cd});
    link({f, 1}, {g, 1});
    link({f, 0}, twin_bd);
    link({f, 2}, twin_ab);
    link({g, 0}, twin_ac);
    link({g, 2}, twin_cd);
    return true;
  }

  void set_face(std::int32_t f, const std::array<std::int32_t, 3>& corners, const std::array<double, 3>& lengths) {
    for (int k = 0; k < 3; ++k) {
      mesh_.faces(f, k) = corners[static_cast<std::size_t>(k)];
      mesh_.lengths(f, k) = lengths[static_cast<std::size_t>(k)];
    }
  }
  void link(Side s, Side t) {
    twin(s) = t;
    twin(t) = s;
  }

  IntrinsicMesh& mesh_;
  std::vector<std::array<Side, 3>> twins_;
};

}  // namespace

IntrinsicMesh intrinsic_mesh(const TriMesh& mesh, double margin) {
  IntrinsicMesh result{mesh.faces, Points(mesh.faces.rows(), 3)};
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      result.lengths(f, k) = (mesh.vertices.row(mesh.faces(f, (k + 1) % 3)) - mesh.vertices.row(mesh.faces(f, (k + 2) % 3))).norm();
  const double slack = margin * result.lengths.mean();
  double growth = 0;
  for (Eigen::Index f = 0; f < result.lengths.rows(); ++f) {
    const double longest = result.lengths.row(f).maxCoeff();
    growth = std::max(growth, slack + 2 * longest - result.lengths.row(f).sum());
  }
  result.lengths.array() += growth;
  return result;
}

void make_delaunay(IntrinsicMesh& mesh) { DelaunayFlipper(mesh).run(); }

Eigen::VectorXd face_areas(const IntrinsicMesh& mesh) {
  Eigen::VectorXd areas(mesh.lengths.rows());
  for (Eigen::Index f = 0; f < areas.size(); ++f) areas[f] = triangle_area(mesh.lengths(f, 0), mesh.lengths(f, 1), mesh.lengths(f, 2));
  return areas;
}

}  // namespace spherematch
