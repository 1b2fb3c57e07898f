#include "engine/io/renderer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/io/map_mesh.h"

namespace spherematch {

namespace {

constexpr int samples = 3;  ///< per pixel and axis
constexpr std::uint8_t white = 255;

using Rgb = std::array<std::uint8_t, 3>;
using Vectors = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// What the triangles of a scene cover: samples of a square, row by row from the top.
struct Canvas {
  int size;
  std::vector<float> depth;  ///< toward the viewer; -infinity where nothing is
  std::vector<Rgb> color;

  explicit Canvas(int n)
      : size(n),
        depth(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), -std::numeric_limits<float>::infinity()),
        color(depth.size(), {white, white, white}) {}
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x);
  }
};

/// The vertices in samples: to the right, down, toward the viewer.
Vectors projected(const Scene& scene, int size) {
  const double scale = scene.pixels_per_unit * samples;
  const Points seen = (scene.mesh.vertices.rowwise() - scene.center.transpose()) * scene.axes.transpose() * scale;
  Vectors positions(seen.rows(), 3);
  positions.col(0) = (seen.col(0).array() + size / 2.0).cast<float>();
  positions.col(1) = (size / 2.0 - seen.col(1).array()).cast<float>();
  positions.col(2) = seen.col(2).cast<float>();
  return positions;
}

/// Area-weighted vertex normals of unit length as the viewer sees them: right, up, toward.
Vectors normals_of(const Scene& scene) {
  Points sums = Points::Zero(scene.mesh.vertex_count(), 3);
  for (Eigen::Index f = 0; f < scene.mesh.face_count(); ++f) {
    const Eigen::RowVector3d a = scene.mesh.vertices.row(scene.mesh.faces(f, 0));
    const Eigen::RowVector3d normal =
        (scene.mesh.vertices.row(scene.mesh.faces(f, 1)) - a).cross(scene.mesh.vertices.row(scene.mesh.faces(f, 2)) - a);
    for (int k = 0; k < 3; ++k) sums.row(scene.mesh.faces(f, k)) += normal;
  }
  return (sums.rowwise().normalized() * scene.axes.transpose()).cast<float>();
}

/// Directions as the viewer sees them: right, up, toward.
struct Lamp {
  const Eigen::Vector3f direction = Eigen::Vector3f(-0.4F, 0.5F, 0.77F).normalized();  ///< beside and above the viewer
  const Eigen::Vector3f halfway = (direction + Eigen::Vector3f::UnitZ()).normalized();
};

/// Soft light, so that no side is black, a little gloss, and darker where the surface turns away.
Rgb shaded(const Lamp& lamp, const Eigen::Vector3f& paint, const Eigen::Vector3f& normal) {
  const Eigen::Vector3f n = normal.normalized();
  const float wrapped = 0.5F + 0.5F * n.dot(lamp.direction);
  const float facing = std::max(0.0F, n.z());
  const float brightness = (0.4F + 0.7F * wrapped * wrapped) * (0.6F + 0.4F * std::sqrt(facing));
  float gloss = std::max(0.0F, n.dot(lamp.halfway));
  for (int i = 0; i < 5; ++i) gloss *= gloss;  // to the power of 32
  Rgb color{};
  for (std::size_t k = 0; k < 3; ++k) {
    const float own = paint(static_cast<Eigen::Index>(k));
    const float base = std::isnan(own) ? neutral_gray / 255.0F : 0.16F + 0.82F * own;
    color[k] = static_cast<std::uint8_t>(std::clamp(256 * (base * brightness + 0.12F * gloss), 0.0F, 255.0F));
  }
  return color;
}

struct Corner {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;
  Eigen::Vector3f paint;
};

/// Twice the signed area of a, b, p.
float edge(const Eigen::Vector3f& a, const Eigen::Vector3f& b, float x, float y) {
  return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

/// The colour that a point's interpolated paint stands for.
Eigen::Vector3f color_of(Paint kind, const Eigen::Vector3f& paint) {
  return kind == Paint::color || std::isnan(paint.x()) ? paint : checker_color(paint.x(), paint.y());
}

void draw(Canvas& canvas, const Lamp& lamp, const Scene& scene, const std::array<Corner, 3>& corners) {
  const auto& [a, b, c] = corners;
  // Seen from behind, or from the side; rows run downward, so that what faces the viewer is negative.
  const float area = edge(a.position, b.position, c.position.x(), c.position.y());
  const bool faces_viewer = area < 0;
  if (!faces_viewer && !(scene.two_sided && area > 0)) return;
  const float outward = faces_viewer ? 1.0F : -1.0F;
  const float inverse = 1 / area;
  const auto first = [](float low) { return static_cast<int>(std::max(0.0F, std::ceil(low - 0.5F))); };
  const auto last = [&](float high) { return static_cast<int>(std::min(static_cast<float>(canvas.size - 1), std::floor(high - 0.5F))); };
  const auto low = a.position.cwiseMin(b.position).cwiseMin(c.position).eval();
  const auto high = a.position.cwiseMax(b.position).cwiseMax(c.position).eval();
  for (int y = first(low.y()); y <= last(high.y()); ++y) {
    for (int x = first(low.x()); x <= last(high.x()); ++x) {
      const float px = static_cast<float>(x) + 0.5F;
      const float py = static_cast<float>(y) + 0.5F;
      const float u = edge(b.position, c.position, px, py) * inverse;
      const float v = edge(c.position, a.position, px, py) * inverse;
      const float w = 1 - u - v;
      if (u < 0 || v < 0 || w < 0) continue;
      const float z = u * a.position.z() + v * b.position.z() + w * c.position.z();
      float& depth = canvas.depth[canvas.index(x, y)];
      if (z <= depth) continue;
      depth = z;
      canvas.color[canvas.index(x, y)] = shaded(lamp, color_of(scene.kind, u * a.paint + v * b.paint + w * c.paint),
                                                outward * (u * a.normal + v * b.normal + w * c.normal));
    }
  }
}

/// The mean colour of the samples of a pixel, or of those that are covered, and their share.
void average(const Canvas& canvas, const Image& image, int x, int y, std::uint8_t* pixel) {
  constexpr int all = samples * samples;
  const bool opaque = image.background == Background::white;
  std::array<int, 3> sum{};
  int counted = 0;
  for (int j = 0; j < samples; ++j) {
    for (int i = 0; i < samples; ++i) {
      const std::size_t sample = canvas.index(x * samples + i, y * samples + j);
      if (!opaque && std::isinf(canvas.depth[sample])) continue;
      for (std::size_t k = 0; k < 3; ++k) sum[k] += canvas.color[sample][k];
      ++counted;
    }
  }
  for (std::size_t k = 0; k < 3; ++k) pixel[k] = counted == 0 ? 0 : static_cast<std::uint8_t>((sum[k] + counted / 2) / counted);
  if (!opaque) pixel[3] = static_cast<std::uint8_t>((255 * counted + all / 2) / all);
}

}  // namespace

Image::Image(int w, int h, Background behind) : width(w), height(h), background(behind) {
  pixels.resize(static_cast<std::size_t>(channels()) * static_cast<std::size_t>(w) * static_cast<std::size_t>(h),
                behind == Background::white ? white : std::uint8_t{0});
}

Eigen::Vector3f checker_color(float u, float v) {
  constexpr float fields = 8;
  u -= std::floor(u);
  v -= std::floor(v);
  // Red, yellow, green, blue and back to red along u, softened so that shading stays visible.
  const float turn = 6 * u;
  const Eigen::Vector3f hue(std::abs(turn - 3) - 1, 2 - std::abs(turn - 2), 2 - std::abs(turn - 4));
  const Eigen::Vector3f bright = Eigen::Vector3f::Constant(0.25F) + 0.75F * hue.cwiseMax(0.0F).cwiseMin(1.0F);
  const bool odd = (static_cast<int>(fields * u) + static_cast<int>(fields * v)) % 2 != 0;
  return odd ? Eigen::Vector3f::Constant(0.92F - 0.25F * (1 - v)) : Eigen::Vector3f(bright * (0.35F + 0.55F * v));
}

void render(const Scene& scene, Image& image, int left) {
  Canvas canvas(image.height * samples);
  const Lamp lamp;
  const Vectors positions = projected(scene, canvas.size);
  const Vectors normals = normals_of(scene);
  for (Eigen::Index f = 0; f < scene.mesh.face_count(); ++f) {
    std::array<Corner, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t v = scene.mesh.faces(f, k);
      corners[static_cast<std::size_t>(k)] = {positions.row(v), normals.row(v), scene.paint.row(v).cast<float>()};
    }
    draw(canvas, lamp, scene, corners);
  }
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.height; ++x) average(canvas, image, x, y, image.at(left + x, y));
}

}  // namespace spherematch
