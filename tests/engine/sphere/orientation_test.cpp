#include "engine/sphere/orientation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/engine/sphere/spheres.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

using test::icosphere;
using test::Random;

constexpr double pi = std::numbers::pi;

__extension__ using Wide = __int128;
using IntegerVector = std::array<std::int64_t, 3>;  ///< multiples of 2^-40, at most 2^40 in magnitude

Eigen::Vector3d to_double(const IntegerVector& v) {
  return Eigen::Vector3d(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])) * 0x1p-40;
}

IntegerVector to_grid(const Eigen::Vector3d& v) {
  return {std::llround(v[0] * 0x1p40), std::llround(v[1] * 0x1p40), std::llround(v[2] * 0x1p40)};
}

/// The determinant's sign; 6 * 2^120 fits into the 127 bits.
int exact_sign(const IntegerVector& a, const IntegerVector& b, const IntegerVector& c) {
  const auto minor = [&](std::size_t i, std::size_t j) { return Wide(b[i]) * c[j] - Wide(b[j]) * c[i]; };
  const Wide det = a[0] * minor(1, 2) + a[1] * minor(2, 0) + a[2] * minor(0, 1);
  return det > 0 ? 1 : (det < 0 ? -1 : 0);
}

TEST(Orientation, IsExactOnNearlyDegenerateTriangles) {
  Random random(1);
  int wrong_in_doubles = 0, zeros = 0;
  for (int i = 0; i < 20000; ++i) {
    // Corners close together and close to one great circle: determinants down to 1e-23 and zero.
    const double spread = std::pow(10.0, -random.uniform(0, 11));
    const Eigen::Vector3d a = 0.99 * random.unit_vector(), b = a + spread * random.unit_vector() * 0.01;
    const double t = random.uniform(-1, 2);
    const IntegerVector u = to_grid(a), v = to_grid(b);
    IntegerVector w = to_grid((1 - t) * to_double(u) + t * to_double(v));
    w[random.bits() % 3] += random.below(3) - 1;
    if (i % 10 == 0) w = {2 * v[0] - u[0], 2 * v[1] - u[1], 2 * v[2] - u[2]};  // exactly on the circle
    const Eigen::Vector3d p = to_double(u), q = to_double(v), r = to_double(w);
    const int exact = exact_sign(u, v, w);
    ASSERT_EQ(orientation(p, q, r), exact) << i;
    ASSERT_EQ(orientation(q, p, r), -exact) << i;
    ASSERT_EQ(orientation(q, r, p), exact) << i;
    const double det = p.dot(q.cross(r));
    wrong_in_doubles += (det > 0 ? 1 : (det < 0 ? -1 : 0)) != exact ? 1 : 0;
    zeros += exact == 0 ? 1 : 0;
  }
  // The cases are hard: plain arithmetic fails at many of them.
  EXPECT_GT(wrong_in_doubles, 200);
  EXPECT_GT(zeros, 500);
}

TEST(Orientation, IsAntisymmetricOnUnitVectorsAlongAGreatCircle) {
  Random random(2);
  int positive = 0, negative = 0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d a = random.unit_vector(), b = random.unit_vector(), c = (a + random.uniform(0, 3) * b).normalized();
    const int sign = orientation(a, b, c);
    positive += sign > 0 ? 1 : 0;
    negative += sign < 0 ? 1 : 0;
    ASSERT_EQ(orientation(b, c, a), sign);
    ASSERT_EQ(orientation(c, a, b), sign);
    ASSERT_EQ(orientation(b, a, c), -sign);
    ASSERT_EQ(orientation(-a, b, c), -sign);
  }
  // Rounding alone decides, so both happen, about equally often.
  EXPECT_GT(positive, 1000);
  EXPECT_GT(negative, 1000);
}

TEST(Orientation, OfEqualOppositeAndCoplanarVectorsIsZero) {
  const Eigen::Vector3d a = Eigen::Vector3d(0.3, -0.5, 0.7).normalized(), b = Eigen::Vector3d(-0.1, 0.9, 0.2).normalized();
  EXPECT_EQ(orientation(a, b, a), 0);
  EXPECT_EQ(orientation(a, b, -a), 0);
  EXPECT_EQ(orientation({1, 0, 0}, {0, 1, 0}, {-0.6, 0.8, 0}), 0);
  EXPECT_EQ(orientation({1, 0, 0}, {0, 1, 0}, {-0.6, 0.8, 5e-324}), 1);
  EXPECT_EQ(orientation({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(orientation({0, 1, 0}, {1, 0, 0}, {0, 0, 1}), -1);
}

TEST(FlippedFaces, AreThoseThatAMovedVertexTurnsOver) {
  const TriMesh mesh = icosphere(2);
  EXPECT_TRUE(flipped_faces(mesh.vertices, mesh.faces).empty());

  // A vertex pulled across its ring's far side turns over the faces whose outer edge it has crossed.
  Points moved = mesh.vertices;
  const std::int32_t vertex = 20;
  moved.row(vertex) = (mesh.vertices.row(vertex) + 0.6 * Eigen::RowVector3d(0.3, -0.8, 0.5)).normalized();
  const Eigen::VectorXd angles = test::solid_angles(moved, mesh.faces);
  std::vector<std::int32_t> expected;
  for (Eigen::Index f = 0; f < angles.size(); ++f)
    if (angles[f] <= 0) expected.push_back(static_cast<std::int32_t>(f));
  ASSERT_GE(expected.size(), 1U);
  EXPECT_EQ(flipped_faces(moved, mesh.faces), expected);

  // Two vertices at one place leave the two faces of their edge without an inside.
  Points pinched = mesh.vertices;
  pinched.row(mesh.faces(7, 1)) = pinched.row(mesh.faces(7, 0));
  const std::vector<std::int32_t> flat = flipped_faces(pinched, mesh.faces);
  EXPECT_GE(flat.size(), 2U);
  EXPECT_NE(std::find(flat.begin(), flat.end(), 7), flat.end());
  EXPECT_TRUE(std::is_sorted(flat.begin(), flat.end()));

  const TriMesh inside_out = test::turned_inside_out(mesh);
  EXPECT_EQ(static_cast<Eigen::Index>(flipped_faces(inside_out.vertices, inside_out.faces).size()), mesh.face_count());
}

TEST(TotalSolidAngle, IsFourPiTimesTheDegree) {
  Random random(3);
  for (const TriMesh& mesh : {test::octahedron(), icosphere(0), icosphere(4)}) {
    const Points sphere = test::rotated(mesh.vertices, random.rotation()).rowwise().normalized();
    // Measured: 2e-15.
    EXPECT_NEAR(total_solid_angle(sphere, mesh.faces), 4 * pi, 1e-13);
    const TriMesh inside_out = test::turned_inside_out(mesh);
    EXPECT_NEAR(total_solid_angle(inside_out.vertices, inside_out.faces), -4 * pi, 1e-13);
  }
  // Flips fold the sphere over itself but do not change how often it is covered.
  const TriMesh mesh = icosphere(3);
  Points folded = mesh.vertices;
  for (Eigen::Index v = 0; v < folded.rows(); ++v) folded.row(v) = (folded.row(v) + 0.15 * random.unit_vector().transpose()).normalized();
  EXPECT_GT(flipped_faces(folded, mesh.faces).size(), 20U);
  EXPECT_NEAR(total_solid_angle(folded, mesh.faces), 4 * pi, 1e-12);
}

TEST(MeasureSphere, KnowsTheDistortionOfAStretchedBipyramid) {
  // Four faces of area A and four of area B on the surface, all equal on the sphere.
  TriMesh surface = test::octahedron();
  surface.vertices.row(2) *= 5;
  const double a = std::sqrt(0.25 + 2 * 25.0 / 4), b = std::sqrt(0.75), total = 4 * (a + b);
  const double expected = 4 * a / total * std::abs(std::log(total / (8 * a))) + 4 * b / total * std::abs(std::log(total / (8 * b)));
  const Points sphere = test::octahedron().vertices;
  for (const double scale : {1.0, 1e-8, 1e8}) {
    const SphereQuality quality = measure_sphere(sphere, test::transformed(surface, scale, test::some_rotation(), {1, 2, 3}));
    EXPECT_EQ(quality.flipped, 0);
    EXPECT_LT(quality.solid_angle_defect, 1e-13);
    // A shift by 1e8 edge lengths costs eight digits. Measured: 8e-10.
    EXPECT_NEAR(quality.area_distortion, expected, scale < 1 ? 1e-8 : 1e-13);
  }
  EXPECT_GT(expected, 0.3);

  const TriMesh mesh = icosphere(3);
  EXPECT_LT(measure_sphere(mesh.vertices, mesh).area_distortion, 1e-12);
  const TriMesh inside_out = test::turned_inside_out(mesh);
  EXPECT_EQ(measure_sphere(inside_out.vertices, inside_out).flipped, 1280);
  EXPECT_NEAR(measure_sphere(inside_out.vertices, inside_out).solid_angle_defect, 8 * pi, 1e-12);
}

}  // namespace
}  // namespace spherematch
