#include "engine/sphere/mobius.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/mesh/laplacian.h"
#include "engine/sphere/orientation.h"
#include "tests/engine/sphere/spheres.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

using test::icosphere;
using test::Random;

/// Areas of the faces, of sum one.
Eigen::VectorXd shares(const Points& vertices, const Triangles& faces) {
  const Eigen::VectorXd areas = face_areas(vertices, faces);
  return areas / areas.sum();
}

TEST(Boost, IsUndoneByTheOppositeBoost) {
  Random random(1);
  const Points start = icosphere(3).vertices;
  for (const double size : {0.0, 1e-9, 0.3, 0.7, 0.99}) {
    const Eigen::Vector3d c = size * random.unit_vector();
    Points sphere = start;
    boost(sphere, c);
    EXPECT_LT((sphere.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
    boost(sphere, -c);
    // The inverse of a strong boost stretches rounding errors by (1 + |c|) / (1 - |c|).
    EXPECT_LT((sphere - start).rowwise().norm().maxCoeff(), 1e-15 * (1 + size) / (1 - size));
  }
}

TEST(Boost, KeepsCrossRatiosAndMovesTowardsItsVector) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    Points p(4, 3);
    for (Eigen::Index k = 0; k < 4; ++k) p.row(k) = random.unit_vector().transpose();
    const auto ratio = [](const Points& q) {
      return (q.row(0) - q.row(1)).norm() * (q.row(2) - q.row(3)).norm() / ((q.row(0) - q.row(2)).norm() * (q.row(1) - q.row(3)).norm());
    };
    const double before = ratio(p);
    const Eigen::Vector3d c = 0.8 * random.unit_vector();
    const Points start = p;
    boost(p, c);
    EXPECT_NEAR(ratio(p), before, 1e-13 * (1 + before));
    for (Eigen::Index k = 0; k < 4; ++k) EXPECT_GT(p.row(k).dot(c), start.row(k).dot(c));
  }
  Points fixed(2, 3);
  fixed << 0.6, 0, 0.8, -0.6, 0, -0.8;
  const Points poles = fixed;
  boost(fixed, 0.5 * poles.row(0).transpose());
  EXPECT_LT((fixed - poles).norm(), 1e-15);
}

/// Uneven masses without symmetry.
Eigen::VectorXd uneven_mass(const TriMesh& mesh) {
  Eigen::VectorXd mass = face_areas(mesh.vertices, mesh.faces);
  for (Eigen::Index f = 0; f < mass.size(); ++f)
    mass[f] *= std::exp(1.5 * test::smooth_function(mesh.vertices.row(mesh.faces(f, 0)).transpose()));
  return mass / mass.sum();
}

TEST(Center, UndoesABoostUpToARotation) {
  const TriMesh mesh = icosphere(3);
  const Eigen::VectorXd uneven = uneven_mass(mesh);
  Points centred = mesh.vertices;
  ASSERT_LE(center(centred, mesh.faces, uneven), 1e-10);
  const auto expect_restored = [&](const Points& start, const Eigen::VectorXd& mass, double size) {
    Points sphere = start;
    boost(sphere, size * Random(3).unit_vector());
    EXPECT_LE(center(sphere, mesh.faces, mass), 1e-10) << "|c| = " << size;
    // About as exact as the centre.
    EXPECT_LT((sphere * sphere.transpose() - start * start.transpose()).cwiseAbs().maxCoeff(), 1e-9) << "|c| = " << size;
  };
  for (const double size : {0.3, 0.6, 0.7}) {
    expect_restored(mesh.vertices, shares(mesh.vertices, mesh.faces), size);
    expect_restored(centred, uneven, size);
  }
}

TEST(Center, SucceedsAfterBoostsOfAnyStrength) {
  const TriMesh mesh = icosphere(3);
  const Eigen::VectorXd mass = shares(mesh.vertices, mesh.faces);
  for (int i = 0; i < 20; ++i) {
    Points sphere = mesh.vertices;
    const double size = 0.05 * i;
    boost(sphere, size * Random(5).unit_vector());
    EXPECT_LE(center(sphere, mesh.faces, mass), 1e-10) << "|c| = " << size;
  }
}

TEST(Center, ConvergesAlmostQuadraticallyToTheOrigin) {
  const TriMesh mesh = icosphere(3);
  const Eigen::VectorXd mass = uneven_mass(mesh);
  Points sphere = mesh.vertices;
  std::vector<double> distances;
  for (int i = 0; i < 12; ++i) distances.push_back(centering_step(sphere, mesh.faces, mass));
  EXPECT_GT(distances.front(), 0.2);
  // Measured: 0.32, 0.019, 1.3e-5, 5.6e-10, 2.7e-14.
  for (std::size_t i = 0; i + 1 < distances.size(); ++i)
    EXPECT_LT(distances[i + 1], std::max(4 * std::pow(distances[i], 1.8), 1e-13)) << "step " << i;
  // Already centred: nothing changes but by rounding.
  EXPECT_LT(distances.back(), 1e-14);
  const Points centred = sphere;
  EXPECT_LE(center(sphere, mesh.faces, mass), 1e-10);
  EXPECT_LT((sphere - centred).norm(), 1e-12);
}

TEST(CenteringStep, OfMassAtVerticesConvergesToo) {
  const TriMesh mesh = icosphere(3);
  Eigen::VectorXd mass(mesh.vertex_count());
  for (Eigen::Index v = 0; v < mass.size(); ++v) mass[v] = std::exp(1.5 * test::smooth_function(mesh.vertices.row(v).transpose()));
  mass /= mass.sum();
  Points sphere = mesh.vertices;
  const double first = centering_step(sphere, mass);
  EXPECT_NEAR(first, (mesh.vertices.transpose() * mass).norm(), 1e-15);
  EXPECT_GT(first, 0.2);
  for (int i = 0; i < 6; ++i) (void)centering_step(sphere, mass);
  EXPECT_LT((sphere.transpose() * mass).norm(), 1e-14);
}

TEST(Center, StaysFiniteWhereNoCentreExists) {
  const TriMesh mesh = icosphere(2);
  Eigen::VectorXd mass = Eigen::VectorXd::Constant(mesh.face_count(), 0.2 / static_cast<double>(mesh.face_count() - 1));
  mass[11] = 0.8;
  Points sphere = mesh.vertices;
  const double distance = center(sphere, mesh.faces, mass);
  EXPECT_TRUE(std::isfinite(distance));
  ASSERT_TRUE(sphere.allFinite());
  EXPECT_LT((sphere.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
}

TEST(RotateToPrincipalAxes, ForgetsHowTheInputWasTurned) {
  // Masses of a body without symmetry on a sphere that is not aligned with it.
  const TriMesh body = test::creature(3);
  const Eigen::VectorXd mass = shares(body.vertices, body.faces);
  const Points start = body.vertices.rowwise().normalized();
  Points reference = start;
  rotate_to_principal_axes(reference, body.faces, mass);
  Random random(4);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Matrix3d turn =
        i == 0 ? Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()).toRotationMatrix() : random.rotation();
    Points sphere = test::rotated(start, turn);
    rotate_to_principal_axes(sphere, body.faces, mass);
    // Measured: 4e-15.
    EXPECT_LT((sphere - reference).rowwise().norm().maxCoeff(), 1e-13);
  }
}

TEST(RotateToPrincipalAxes, IsARotationAndDiagonalisesTheMass) {
  const TriMesh body = test::creature(3);
  const Eigen::VectorXd mass = shares(body.vertices, body.faces);
  const Points start = body.vertices.rowwise().normalized();
  Points sphere = start;
  rotate_to_principal_axes(sphere, body.faces, mass);
  EXPECT_LT((sphere * sphere.transpose() - start * start.transpose()).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_TRUE(flipped_faces(sphere, body.faces).empty()) << "a reflection";
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (Eigen::Index f = 0; f < body.face_count(); ++f) {
    const Eigen::Vector3d c =
        (sphere.row(body.faces(f, 0)) + sphere.row(body.faces(f, 1)) + sphere.row(body.faces(f, 2))).transpose().normalized();
    second += mass[f] * c * c.transpose();
  }
  const Eigen::Matrix3d off = second - Eigen::Matrix3d(second.diagonal().asDiagonal());
  EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_GT(second.diagonal().maxCoeff() - second.diagonal().minCoeff(), 0.01);
}

}  // namespace
}  // namespace spherematch
