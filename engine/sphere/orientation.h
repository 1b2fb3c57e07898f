// Exact orientation of spherical triangles, and the quality of a spherical parametrisation.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/data/preprocessed_shape.h"
#include "engine/data/tri_mesh.h"

namespace spherematch {

/// Sign of det(a, b, c): +1 when the triangle is counter-clockwise seen from outside, 0 when it is degenerate.
/// Exact for vectors no longer than one and a half.
[[nodiscard]] int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Faces whose orientation is not positive, ascending.
[[nodiscard]] std::vector<std::int32_t> flipped_faces(const Points& sphere, const Triangles& faces);

/// Sum over the faces of the signed solid angle; 4 pi for a parametrisation of degree one.
[[nodiscard]] double total_solid_angle(const Points& sphere, const Triangles& faces);

[[nodiscard]] SphereQuality measure_sphere(const Points& sphere, const TriMesh& surface);

}  // namespace spherematch
