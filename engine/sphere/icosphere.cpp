#include "engine/sphere/icosphere.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace spherematch {
namespace {

using Face = std::array<std::int32_t, 3>;

/// The vertices are those of three golden rectangles.
std::vector<Eigen::Vector3d> icosahedron_vertices() {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  std::vector<Eigen::Vector3d> vertices;
  for (int axis = 0; axis < 3; ++axis)
    for (const double a : {-1.0, 1.0})
      for (const double b : {-golden, golden}) {
        Eigen::Vector3d p;
        p[axis] = 0;
        p[(axis + 1) % 3] = a;
        p[(axis + 2) % 3] = b;
        vertices.push_back(p.normalized());
      }
  return vertices;
}

/// All triples at an edge's distance from each other, counter-clockwise seen from outside.
std::vector<Face> icosahedron_faces(const std::vector<Eigen::Vector3d>& vertices) {
  const double edge = 2 / std::sqrt(1 + std::pow((1 + std::sqrt(5.0)) / 2, 2));
  const auto adjacent = [&](std::size_t i, std::size_t j) { return std::abs((vertices[i] - vertices[j]).norm() - edge) < 1e-6; };
  std::vector<Face> faces;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (std::size_t j = i + 1; j < vertices.size(); ++j)
      for (std::size_t k = j + 1; k < vertices.size(); ++k) {
        if (!adjacent(i, j) || !adjacent(j, k) || !adjacent(k, i)) continue;
        const bool outward = vertices[i].dot(vertices[j].cross(vertices[k])) > 0;
        const auto a = static_cast<std::int32_t>(i), b = static_cast<std::int32_t>(j), c = static_cast<std::int32_t>(k);
        faces.push_back(outward ? Face{a, b, c} : Face{a, c, b});
      }
  return faces;
}

std::vector<Face> subdivided(const std::vector<Face>& faces, std::vector<Eigen::Vector3d>& vertices) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [found, added] = middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(vertices.size()));
    if (added) vertices.push_back((vertices[static_cast<std::size_t>(a)] + vertices[static_cast<std::size_t>(b)]).normalized());
    return found->second;
  };
  std::vector<Face> result;
  for (const auto& [a, b, c] : faces) {
    const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Face& face : {Face{a, ab, ca}, Face{ab, b, bc}, Face{ca, bc, c}, Face{ab, bc, ca}}) result.push_back(face);
  }
  return result;
}

}  // namespace

TriMesh icosphere(int subdivisions) {
  std::vector<Eigen::Vector3d> vertices = icosahedron_vertices();
  std::vector<Face> faces = icosahedron_faces(vertices);
  for (int i = 0; i < subdivisions; ++i) faces = subdivided(faces, vertices);
  TriMesh mesh{Points(static_cast<Eigen::Index>(vertices.size()), 3), Triangles(static_cast<Eigen::Index>(faces.size()), 3)};
  for (std::size_t v = 0; v < vertices.size(); ++v) mesh.vertices.row(static_cast<Eigen::Index>(v)) = vertices[v];
  for (std::size_t f = 0; f < faces.size(); ++f) mesh.faces.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
  return mesh;
}

}  // namespace spherematch
