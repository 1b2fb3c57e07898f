// Moebius centering (Baden, Crane, Kazhdan 2018; paper 3.1) and a canonical rotation after it.
#pragma once

#include <Eigen/Core>

#include "engine/data/tri_mesh.h"

namespace spherematch {

/// The conformal map of the sphere p -> (1 - |c|^2) (p + c) / |p + c|^2 + c, |c| < 1; its inverse has -c.
void boost(Points& sphere, const Eigen::Vector3d& c);

/// One Poincare step towards a centre of mass at the origin, the mass `face_mass` (F, sum 1) standing at the faces' centres.
/// Returns the distance of the centre of mass from the origin before the step.
double centering_step(Points& sphere, const Triangles& faces, const Eigen::VectorXd& face_mass);

/// The same with the mass at the vertices, (V, sum 1), which is faster.
double centering_step(Points& sphere, const Eigen::VectorXd& vertex_mass);

/// Repeats centering_step until the centre of mass is within 1e-10 of the origin, at most 100 times.
/// Returns the distance that remains.
double center(Points& sphere, const Triangles& faces, const Eigen::VectorXd& face_mass);

/// Rotates the sphere into a frame that depends on the surface alone, not on how the mesh was turned: the principal axes of the
/// mass on the sphere, with signs from its third moments. Takes the dependence on the grid's poles out of later stages.
void rotate_to_principal_axes(Points& sphere, const Triangles& faces, const Eigen::VectorXd& face_mass);

}  // namespace spherematch
