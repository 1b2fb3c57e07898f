#include "engine/sphere/rasterizer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace spherematch {
namespace {

/// A point of a flat triangle: its position relative to the grid's axis and its barycentric coordinates.
struct ClipPoint {
  double x, y, z;
  double radius;  ///< distance to the polar axis; linear along the pieces' edges up to their width squared
  double b1, b2;
};

ClipPoint interpolate(const ClipPoint& p, const ClipPoint& q, double t) {
  const auto mix = [t](double a, double b) { return a + t * (b - a); };
  const double x = mix(p.x, q.x), y = mix(p.y, q.y);
  return {x, y, mix(p.z, q.z), std::sqrt(x * x + y * y), mix(p.b1, q.b1), mix(p.b2, q.b2)};
}

/// A convex polygon; each cut adds at most one corner. Only the first `size` points are ever read.
struct ClipPolygon {  // NOLINT(cppcoreguidelines-pro-type-member-init)
  std::array<ClipPoint, 16> points;
  std::size_t size = 0;

  void add(const ClipPoint& p) {
    if (size < points.size()) points[size++] = p;
  }
};

/// Splits `polygon` by the zero set of `height`, which is linear along edges.
template <typename Height>
void split(const ClipPolygon& polygon, const Height& height, ClipPolygon& below, ClipPolygon& above) {
  below.size = above.size = 0;
  if (polygon.size == 0) return;
  double h = height(polygon.points[0]);
  const double first = h;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const bool last = i + 1 == polygon.size;
    const ClipPoint& p = polygon.points[i];
    const ClipPoint& q = polygon.points[last ? 0 : i + 1];
    const double next = last ? first : height(q);
    if (h <= 0) below.add(p);
    if (h >= 0) above.add(p);
    if ((h < 0 && next > 0) || (h > 0 && next < 0)) {
      const ClipPoint cut = interpolate(p, q, h / (h - next));
      below.add(cut);
      above.add(cut);
    }
    h = next;
  }
}

/// Directions of the grid lines.
struct GridLines {
  explicit GridLines(int n) : resolution(n) {
    for (int i = 0; i <= n; ++i) {
      const double longitude = 2 * std::numbers::pi * i / n, colatitude = std::numbers::pi * i / n;
      meridian.emplace_back(std::cos(longitude), std::sin(longitude));
      parallel.emplace_back(std::cos(colatitude), std::sin(colatitude));
    }
  }
  int resolution;
  std::vector<Eigen::Vector2d> meridian, parallel;  ///< (cos, sin)
};

template <typename Deposit>
class FaceRasterizer {
 public:
  FaceRasterizer(const GridLines& lines, Deposit& deposit) : lines_(lines), deposit_(deposit) {}

  void rasterize(Eigen::Index face, const std::array<ClipPoint, 3>& corners) {
    face_ = face;
    ClipPolygon triangle;
    for (const ClipPoint& p : corners) triangle.add(p);
    const auto [lowest, highest] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    if (lowest >= 0) {
      half(triangle, false);
    } else if (highest <= 0) {
      half(triangle, true);
    } else {  // the seam of longitude 0, and with it the axis
      ClipPolygon west, east;
      split(
          triangle, [](const ClipPoint& p) { return p.y; }, west, east);
      half(east, false);
      half(west, true);
    }
  }

 private:
  /// A polygon on one side of the plane y = 0, where longitude does not wrap.
  void half(const ClipPolygon& polygon, bool west) {
    const int n = lines_.resolution, lower = west ? n / 2 : 0, upper = west ? n - 1 : n / 2 - 1;
    double least = 2, most = -2;  // of a stand-in for the longitude that needs no arc tangent
    for (std::size_t i = 0; i < polygon.size; ++i) {
      const ClipPoint& p = polygon.points[i];
      if (p.radius < 1e-14) continue;  // on the axis every longitude is right
      const double cosine = p.x / (std::abs(p.x) + std::abs(p.y));
      least = std::min(least, cosine);
      most = std::max(most, cosine);
    }
    if (least > most) return;
    const auto column_of = [&](double cosine) {
      const double angle = std::atan2(1 - std::abs(cosine), cosine);
      return std::clamp(static_cast<int>((west ? 2 * std::numbers::pi - angle : angle) * n / (2 * std::numbers::pi)), lower, upper);
    };
    const int first = column_of(west ? least : most), last = column_of(west ? most : least);
    ClipPolygon rest = polygon, strip, remainder;
    for (int column = first; column < last; ++column) {
      const Eigen::Vector2d& line = lines_.meridian[static_cast<std::size_t>(column) + 1];
      split(
          rest, [&line](const ClipPoint& p) { return p.y * line[0] - p.x * line[1]; }, strip, remainder);
      rows(strip, column);
      rest = remainder;
    }
    rows(rest, last);
  }

  /// A polygon within one column.
  void rows(const ClipPolygon& polygon, int column) {
    if (polygon.size < 3) return;
    const int n = lines_.resolution;
    double least = 2, most = -2;  // of a stand-in for the cosine of the colatitude
    for (std::size_t i = 0; i < polygon.size; ++i) {
      const ClipPoint& p = polygon.points[i];
      const double cosine = p.z / (p.radius + std::abs(p.z));
      least = std::min(least, cosine);
      most = std::max(most, cosine);
    }
    const auto row_of = [n](double cosine) {
      return std::clamp(static_cast<int>(std::atan2(1 - std::abs(cosine), cosine) * n / std::numbers::pi), 0, n - 1);
    };
    const int first = row_of(most), last = row_of(least);
    ClipPolygon rest = polygon, strip, remainder;
    for (int row = first; row < last; ++row) {
      const Eigen::Vector2d& line = lines_.parallel[static_cast<std::size_t>(row) + 1];
      split(
          rest, [&line](const ClipPoint& p) { return p.radius * line[0] - p.z * line[1]; }, strip, remainder);
      piece(strip, row, column);
      rest = remainder;
    }
    piece(rest, last, column);
  }

  void piece(const ClipPolygon& polygon, int row, int column) {
    const ClipPoint& o = polygon.points[0];
    double area = 0, m1 = 0, m2 = 0;  // twice the area in the barycentric plane, three times its first moments
    for (std::size_t i = 1; i + 1 < polygon.size; ++i) {
      const ClipPoint &p = polygon.points[i], &q = polygon.points[i + 1];
      const double a = (p.b1 - o.b1) * (q.b2 - o.b2) - (p.b2 - o.b2) * (q.b1 - o.b1);
      area += a;
      m1 += a * (o.b1 + p.b1 + q.b1);
      m2 += a * (o.b2 + p.b2 + q.b2);
    }
    if (!(area > 0)) return;
    const double b1 = m1 / (3 * area), b2 = m2 / (3 * area);
    deposit_(RasterPiece{static_cast<Eigen::Index>(row) * lines_.resolution + column, face_, area, {1 - b1 - b2, b1, b2}});
  }

  const GridLines& lines_;
  Deposit& deposit_;
  Eigen::Index face_ = 0;
};

/// Where a vertex stands on the grid.
struct VertexCell {
  ClipPoint point;
  int row, column;
};

std::vector<VertexCell> locate_vertices(const Points& sphere, int n) {
  std::vector<VertexCell> cells(static_cast<std::size_t>(sphere.rows()));
  for (Eigen::Index v = 0; v < sphere.rows(); ++v) {
    const double x = sphere(v, 0), y = sphere(v, 1), z = sphere(v, 2), radius = std::sqrt(x * x + y * y);
    double longitude = std::atan2(y, x);
    if (longitude < 0) longitude += 2 * std::numbers::pi;
    cells[static_cast<std::size_t>(v)] = {{x, y, z, radius, 0, 0},
                                          std::clamp(static_cast<int>(std::atan2(radius, z) * n / std::numbers::pi), 0, n - 1),
                                          std::clamp(static_cast<int>(longitude * n / (2 * std::numbers::pi)), 0, n - 1)};
  }
  return cells;
}

template <typename Deposit>
void for_each_piece(const Points& sphere, const Triangles& faces, int resolution, Deposit deposit) {
  const GridLines lines(resolution);
  const std::vector<VertexCell> cells = locate_vertices(sphere, resolution);
  FaceRasterizer<Deposit> rasterizer(lines, deposit);
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const VertexCell& a = cells[static_cast<std::size_t>(faces(f, 0))];
    const VertexCell& b = cells[static_cast<std::size_t>(faces(f, 1))];
    const VertexCell& c = cells[static_cast<std::size_t>(faces(f, 2))];
    const bool one_cell = a.row == b.row && a.row == c.row && a.column == b.column && a.column == c.column;
    if (one_cell) {  // a cell is convex but for the curve of its parallels
      deposit(RasterPiece{static_cast<Eigen::Index>(a.row) * resolution + a.column, f, 1.0, Eigen::Vector3d::Constant(1.0 / 3)});
      continue;
    }
    std::array<ClipPoint, 3> corners{a.point, b.point, c.point};
    corners[1].b1 = 1;
    corners[2].b2 = 1;
    rasterizer.rasterize(f, corners);
  }
}

/// Fills cells of zero weight from their nearest neighbours in the row, and rows without any weight from the nearest row.
void fill_empty_cells(const Grid& weight, Grid& values) {
  const Eigen::Index n = values.rows();
  std::vector<Eigen::Index> filled;
  for (Eigen::Index j = 0; j < n; ++j) {
    if (!(weight.row(j) > 0).any()) continue;
    filled.push_back(j);
    for (Eigen::Index i = 0; i < n; ++i) {
      if (weight(j, i) > 0) continue;
      double sum = 0;
      int count = 0;
      for (Eigen::Index reach = 1; reach < n && count == 0; ++reach)
        for (const Eigen::Index k : {(i + reach) % n, (i + n - reach) % n})
          if (weight(j, k) > 0) {
            sum += values(j, k);
            ++count;
          }
      values(j, i) = sum / count;
    }
  }
  for (Eigen::Index j = 0; j < n && !filled.empty(); ++j) {
    const auto nearest =
        std::min_element(filled.begin(), filled.end(), [j](Eigen::Index a, Eigen::Index b) { return std::abs(a - j) < std::abs(b - j); });
    if (*nearest != j) values.row(j) = values.row(*nearest);
  }
}

}  // namespace

Grid rasterize_mass(const Points& sphere, const Triangles& faces, const Eigen::VectorXd& face_mass, int resolution) {
  Grid mass = Grid::Zero(resolution, resolution);
  for_each_piece(sphere, faces, resolution,
                 [&](const RasterPiece& piece) { mass.data()[piece.cell] += piece.share * face_mass[piece.face]; });
  return mass;
}

std::vector<Grid> rasterize_signals(const Points& sphere, const Triangles& faces, const Eigen::MatrixXd& values, int resolution) {
  Grid weight = Grid::Zero(resolution, resolution);
  std::vector<Grid> result(static_cast<std::size_t>(values.cols()), weight);
  for_each_piece(sphere, faces, resolution, [&](const RasterPiece& piece) {
    const auto a = faces(piece.face, 0), b = faces(piece.face, 1), c = faces(piece.face, 2);
    const Eigen::Vector3d pa = sphere.row(a), pb = sphere.row(b), pc = sphere.row(c);
    const double area = piece.share * (pb - pa).cross(pc - pa).norm();
    weight.data()[piece.cell] += area;
    for (Eigen::Index k = 0; k < values.cols(); ++k)
      result[static_cast<std::size_t>(k)].data()[piece.cell] +=
          area * (piece.centroid[0] * values(a, k) + piece.centroid[1] * values(b, k) + piece.centroid[2] * values(c, k));
  });
  for (Grid& grid : result) {
    grid /= weight.max(1e-300);
    fill_empty_cells(weight, grid);
  }
  return result;
}

}  // namespace spherematch
