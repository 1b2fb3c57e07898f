// Synthetic meshes for the tests. All are deterministic; closed ones face outward.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/data/tri_mesh.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch::test {

[[nodiscard]] TriMesh tetrahedron();
/// 10 * 4^subdivisions + 2 vertices on the unit sphere.
[[nodiscard]] TriMesh icosphere(int subdivisions);
/// An icosphere with its coordinates scaled.
[[nodiscard]] TriMesh ellipsoid(int subdivisions, const Eigen::Vector3d& half_axes);
/// A star-shaped body without symmetry: a trunk with a head and four limbs of different lengths.
[[nodiscard]] TriMesh creature(int subdivisions);
/// A tube of `tube` edges round, bent to a ring of `ring` edges; tube, ring >= 3. Genus one.
[[nodiscard]] TriMesh torus(int ring, int tube);
/// Closed, one-sided, self-intersecting. The quads along the seam disagree in orientation. ring, tube >= 3.
[[nodiscard]] TriMesh klein_bottle(int ring, int tube);
/// `rings` rings of triangles round a vertex, curved like a shallow bowl; one boundary loop of 6 * rings edges.
[[nodiscard]] TriMesh open_disk(int rings);

/// A cube of side 1 from the origin, made of six quadrilaterals.
[[nodiscard]] PolygonMesh cube();
[[nodiscard]] PolygonMesh polygons(const TriMesh& mesh);
[[nodiscard]] PolygonMesh polygons(const Points& vertices, const std::vector<std::vector<std::int32_t>>& faces);

[[nodiscard]] TriMesh transformed(const TriMesh& mesh, double scale, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& shift);
/// A rotation that leaves no axis where it was.
[[nodiscard]] Eigen::Matrix3d some_rotation();
/// Both meshes in one, the vertices and faces of `b` after those of `a`.
[[nodiscard]] TriMesh joined(const TriMesh& a, const TriMesh& b);
/// Row i of the result is vertex order[i] of the mesh.
[[nodiscard]] TriMesh renumbered(const TriMesh& mesh, std::span<const std::int32_t> order);
/// 0 to count - 1 in an order that depends on the seed alone.
[[nodiscard]] std::vector<std::int32_t> shuffled(std::int32_t count, std::uint64_t seed);
[[nodiscard]] TriMesh turned_inside_out(const TriMesh& mesh);
[[nodiscard]] TriMesh without_faces(const TriMesh& mesh, std::span<const std::int32_t> faces);
/// Changes the number of rows and keeps those that stay; new ones are zero.
void resize_vertices(TriMesh& mesh, Eigen::Index count);
void resize_faces(TriMesh& mesh, Eigen::Index count);
/// Every face with three vertices of its own.
[[nodiscard]] TriMesh triangle_soup(const TriMesh& mesh);

}  // namespace spherematch::test
