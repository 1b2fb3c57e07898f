// Meshes for the tests of the samples, and what they look at.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "samples/surface_mesh.h"
#include "tests/support/meshes.h"

namespace spherematch::samples {

/// A sphere of radius 1 about the origin.
inline Mesh sphere_mesh(int subdivisions) {
  const TriMesh sphere = test::icosphere(subdivisions);
  Mesh mesh;
  for (Eigen::Index v = 0; v < sphere.vertex_count(); ++v)
    mesh.vertices.push_back({sphere.vertices(v, 0), sphere.vertices(v, 1), sphere.vertices(v, 2)});
  for (Eigen::Index f = 0; f < sphere.face_count(); ++f)
    mesh.triangles.push_back({sphere.faces(f, 0), sphere.faces(f, 1), sphere.faces(f, 2)});
  return mesh;
}

/// The smallest angle of each triangle, in degrees.
inline std::vector<double> smallest_angles(const Mesh& mesh) {
  const auto angle = [](const Vec3& p, const Vec3& q, const Vec3& r) {
    return std::acos(dot(q - p, r - p) / (norm(q - p) * norm(r - p))) * 180 / 3.14159265358979;
  };
  std::vector<double> angles;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[static_cast<std::size_t>(t[0])], &b = mesh.vertices[static_cast<std::size_t>(t[1])],
               &c = mesh.vertices[static_cast<std::size_t>(t[2])];
    angles.push_back(std::min({angle(a, b, c), angle(b, c, a), angle(c, a, b)}));
  }
  return angles;
}

/// The part of the angles that is below `degrees`.
inline double share_below(const std::vector<double>& angles, double degrees) {
  return static_cast<double>(std::count_if(angles.begin(), angles.end(), [&](double a) { return a < degrees; })) /
         static_cast<double>(angles.size());
}

}  // namespace spherematch::samples
