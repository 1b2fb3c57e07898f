#include "tests/support/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>

namespace spherematch::test {

namespace {

constexpr double pi = std::numbers::pi;

std::int32_t index(std::size_t i) { return static_cast<std::int32_t>(i); }

TriMesh mesh_of(const std::vector<Eigen::Vector3d>& vertices, const std::vector<std::array<std::int32_t, 3>>& faces) {
  TriMesh mesh;
  mesh.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t v = 0; v < vertices.size(); ++v) mesh.vertices.row(index(v)) = vertices[v].transpose();
  mesh.faces.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) mesh.faces(index(f), index(k)) = faces[f][k];
  return mesh;
}

TriMesh icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::vector<Eigen::Vector3d> vertices{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                        {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (Eigen::Vector3d& v : vertices) v.normalize();
  return mesh_of(vertices,
                 {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                  {3, 9, 4},  {3, 4, 2}, {3, 2, 6}, {3, 6, 8},  {3, 8, 9},   {4, 9, 5}, {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}});
}

TriMesh subdivided(const TriMesh& mesh) {
  std::vector<Eigen::Vector3d> vertices;
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) vertices.emplace_back(mesh.vertices.row(v).transpose());
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [entry, inserted] = middles.try_emplace(std::minmax({a, b}), index(vertices.size()));
    if (inserted) vertices.push_back((mesh.vertices.row(a) + mesh.vertices.row(b)).transpose().normalized());
    return entry->second;
  };
  std::vector<std::array<std::int32_t, 3>> faces;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const std::int32_t a = mesh.faces(f, 0);
    const std::int32_t b = mesh.faces(f, 1);
    const std::int32_t c = mesh.faces(f, 2);
    const std::int32_t ab = middle(a, b);
    const std::int32_t bc = middle(b, c);
    const std::int32_t ca = middle(c, a);
    faces.insert(faces.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return mesh_of(vertices, faces);
}

/// Two triangles for each cell of a grid of ring by tube vertices; vertex(i, j) also for i = ring and j = tube.
template <typename Vertex>
std::vector<std::array<std::int32_t, 3>> grid_faces(int ring, int tube, const Vertex& vertex) {
  std::vector<std::array<std::int32_t, 3>> faces;
  for (int i = 0; i < ring; ++i)
    for (int j = 0; j < tube; ++j) {
      faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      faces.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return faces;
}

}  // namespace

TriMesh tetrahedron() { return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}); }

TriMesh icosphere(int subdivisions) {
  TriMesh mesh = icosahedron();
  for (int i = 0; i < subdivisions; ++i) mesh = subdivided(mesh);
  return mesh;
}

TriMesh ellipsoid(int subdivisions, const Eigen::Vector3d& half_axes) {
  TriMesh mesh = icosphere(subdivisions);
  mesh.vertices = mesh.vertices * half_axes.asDiagonal();
  return mesh;
}

TriMesh creature(int subdivisions) {
  struct Limb {
    Eigen::Vector3d direction;
    double length;
    double sharpness;
  };
  const std::vector<Limb> limbs{{{0.1, 0.2, 1.0}, 0.9, 10},
                                {{1.0, 0.1, 0.3}, 1.5, 18},
                                {{-1.0, 0.2, 0.25}, 1.3, 18},
                                {{0.45, 0.15, -1.0}, 1.9, 16},
                                {{-0.4, -0.1, -1.0}, 1.7, 16}};
  TriMesh mesh = icosphere(subdivisions);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    const Eigen::Vector3d direction = mesh.vertices.row(v).transpose();
    double radius = 0.6;
    for (const Limb& limb : limbs) radius += limb.length * std::exp(limb.sharpness * (direction.dot(limb.direction.normalized()) - 1));
    mesh.vertices.row(v) *= radius;
  }
  return mesh;
}

TriMesh torus(int ring, int tube) {
  std::vector<Eigen::Vector3d> vertices;
  for (int i = 0; i < ring; ++i)
    for (int j = 0; j < tube; ++j) {
      const double u = 2 * pi * i / ring;
      const double v = 2 * pi * j / tube;
      const double radius = 1 + 0.4 * std::cos(v);
      vertices.emplace_back(radius * std::cos(u), radius * std::sin(u), 0.4 * std::sin(v));
    }
  return mesh_of(vertices, grid_faces(ring, tube, [&](int i, int j) { return (i % ring) * tube + j % tube; }));
}

TriMesh klein_bottle(int ring, int tube) {
  std::vector<Eigen::Vector3d> vertices;
  for (int i = 0; i < ring; ++i)
    for (int j = 0; j < tube; ++j) {
      const double u = 2 * pi * i / ring;
      const double v = 2 * pi * j / tube;
      const double across = std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
      const double up = std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v);
      vertices.emplace_back((2 + across) * std::cos(u), (2 + across) * std::sin(u), up);
    }
  // Once round the ring the tube runs the other way.
  const auto vertex = [&](int i, int j) { return i < ring ? i * tube + j % tube : (2 * tube - j) % tube; };
  return mesh_of(vertices, grid_faces(ring, tube, vertex));
}

TriMesh open_disk(int rings) {
  const auto first_of_ring = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  std::vector<Eigen::Vector3d> vertices;
  for (int ring = 0; ring <= rings; ++ring)
    for (int i = 0; i < std::max(1, 6 * ring); ++i) {
      const double radius = static_cast<double>(ring) / rings;
      const double angle = ring == 0 ? 0 : 2 * pi * i / (6 * ring);
      vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), -0.3 * (1 - radius * radius));
    }
  std::vector<std::array<std::int32_t, 3>> faces;
  for (int ring = 1; ring <= rings; ++ring)
    for (int sector = 0; sector < 6; ++sector)
      for (int step = 0; step < ring; ++step) {
        const auto outer = [&](int i) { return first_of_ring(ring) + (sector * ring + i) % (6 * ring); };
        const auto inner = [&](int i) { return ring == 1 ? 0 : first_of_ring(ring - 1) + (sector * (ring - 1) + i) % (6 * (ring - 1)); };
        // The bowl opens upward, so its outside is seen from below.
        faces.push_back({inner(step), outer(step + 1), outer(step)});
        if (step > 0) faces.push_back({inner(step - 1), inner(step), outer(step)});
      }
  return mesh_of(vertices, faces);
}

PolygonMesh cube() {
  Points vertices(8, 3);
  for (Eigen::Index v = 0; v < 8; ++v)
    for (Eigen::Index k = 0; k < 3; ++k) vertices(v, k) = static_cast<double>((v >> k) & 1);
  return polygons(vertices, {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
}

PolygonMesh polygons(const TriMesh& mesh) {
  PolygonMesh result;
  result.vertices = mesh.vertices;
  result.indices.assign(mesh.faces.data(), mesh.faces.data() + mesh.faces.size());
  for (Eigen::Index f = 1; f <= mesh.face_count(); ++f) result.offsets.push_back(static_cast<std::int32_t>(3 * f));
  return result;
}

PolygonMesh polygons(const Points& vertices, const std::vector<std::vector<std::int32_t>>& faces) {
  PolygonMesh result;
  result.vertices = vertices;
  for (const auto& face : faces) {
    result.indices.insert(result.indices.end(), face.begin(), face.end());
    result.offsets.push_back(index(result.indices.size()));
  }
  return result;
}

TriMesh transformed(const TriMesh& mesh, double scale, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& shift) {
  TriMesh result = mesh;
  result.vertices = (scale * mesh.vertices * rotation.transpose()).rowwise() + shift.transpose();
  return result;
}

Eigen::Matrix3d some_rotation() { return Eigen::AngleAxisd(2.1, Eigen::Vector3d(0.3, -0.7, 0.5).normalized()).toRotationMatrix(); }

TriMesh joined(const TriMesh& a, const TriMesh& b) {
  TriMesh result;
  result.vertices.resize(a.vertex_count() + b.vertex_count(), 3);
  result.vertices << a.vertices, b.vertices;
  result.faces.resize(a.face_count() + b.face_count(), 3);
  result.faces << a.faces, (b.faces.array() + static_cast<std::int32_t>(a.vertex_count())).matrix();
  return result;
}

TriMesh renumbered(const TriMesh& mesh, std::span<const std::int32_t> order) {
  TriMesh result = mesh;
  std::vector<std::int32_t> number(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    number[static_cast<std::size_t>(order[i])] = index(i);
    result.vertices.row(index(i)) = mesh.vertices.row(order[i]);
  }
  for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) result.faces.data()[i] = number[static_cast<std::size_t>(mesh.faces.data()[i])];
  return result;
}

std::vector<std::int32_t> shuffled(std::int32_t count, std::uint64_t seed) {
  std::vector<std::int32_t> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  // std::shuffle may differ between libraries; this does not.
  std::mt19937_64 random(seed);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

TriMesh turned_inside_out(const TriMesh& mesh) {
  TriMesh result = mesh;
  result.faces.col(1).swap(result.faces.col(2));
  return result;
}

TriMesh without_faces(const TriMesh& mesh, std::span<const std::int32_t> faces) {
  TriMesh result;
  result.vertices = mesh.vertices;
  result.faces.resize(mesh.face_count() - static_cast<Eigen::Index>(faces.size()), 3);
  Eigen::Index kept = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f)
    if (std::find(faces.begin(), faces.end(), static_cast<std::int32_t>(f)) == faces.end()) result.faces.row(kept++) = mesh.faces.row(f);
  return result;
}

void resize_vertices(TriMesh& mesh, Eigen::Index count) {
  Points vertices = Points::Zero(count, 3);
  const Eigen::Index kept = std::min(count, mesh.vertex_count());
  vertices.topRows(kept) = mesh.vertices.topRows(kept);
  mesh.vertices = vertices;
}

void resize_faces(TriMesh& mesh, Eigen::Index count) {
  Triangles faces = Triangles::Zero(count, 3);
  const Eigen::Index kept = std::min(count, mesh.face_count());
  faces.topRows(kept) = mesh.faces.topRows(kept);
  mesh.faces = faces;
}

TriMesh triangle_soup(const TriMesh& mesh) {
  TriMesh result;
  result.vertices.resize(mesh.faces.size(), 3);
  result.faces.resize(mesh.face_count(), 3);
  for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) {
    result.vertices.row(i) = mesh.vertices.row(mesh.faces.data()[i]);
    result.faces.data()[i] = static_cast<std::int32_t>(i);
  }
  return result;
}

}  // namespace spherematch::test
