#include "engine/spectrum/curvature.h"

#include <Eigen/Geometry>
#include <cmath>

#include "engine/mesh/laplacian.h"

namespace spherematch {
namespace {

/// Unit normals at the vertices, means over the faces around weighted by area; zero where these cancel.
Points vertex_normals(const TriMesh& mesh) {
  Points normals = Points::Zero(mesh.vertex_count(), 3);
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](int k) -> Eigen::Vector3d { return mesh.vertices.row(mesh.faces(f, k)); };
    const Eigen::Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    for (int k = 0; k < 3; ++k) normals.row(mesh.faces(f, k)) += normal.transpose();
  }
  normals.rowwise().normalize();
  return normals;
}

}  // namespace

Eigen::VectorXd smoothed_mean_curvature(const TriMesh& mesh, const Eigen::VectorXd& values, const Eigen::MatrixXf& vectors, double time) {
  const Eigen::VectorXd areas = vertex_areas(mesh.vertices, mesh.faces);
  // The basis is orthonormal in the consistent mass; at the scale of the smoothing lumped areas do, about the centre of the surface.
  const Eigen::RowVector3d centre = areas.transpose() * mesh.vertices / areas.sum();
  const Eigen::MatrixXf weighted = ((mesh.vertices.rowwise() - centre).array().colwise() * areas.array()).matrix().cast<float>();
  Eigen::MatrixXd coefficients = (vectors.transpose() * weighted).cast<double>();
  coefficients.array().colwise() *= values.array() * (-time * values.array()).exp();
  const Eigen::MatrixXf vector = vectors * coefficients.cast<float>();
  Eigen::VectorXd curvature = vector.cast<double>().cwiseProduct(vertex_normals(mesh)).rowwise().sum();
  const double square = curvature.cwiseAbs2().dot(areas) / areas.sum();
  if (square > 0) curvature /= std::sqrt(square);
  return curvature;
}

}  // namespace spherematch
