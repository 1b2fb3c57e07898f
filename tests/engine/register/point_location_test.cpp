#include "engine/register/point_location.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/sphere/mobius.h"
#include "engine/sphere/orientation.h"
#include "tests/engine/sphere/spheres.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

using test::icosphere;
using test::Random;

using LongVector = Eigen::Matrix<long double, 3, 1>;

/// Weights of the corners where the ray of p meets a face, in extended precision.
LongVector exact_weights(const Points& sphere, const Triangles& faces, Eigen::Index f, const Eigen::Vector3d& point) {
  const LongVector p = point.cast<long double>();
  std::array<LongVector, 3> d;
  for (std::size_t k = 0; k < 3; ++k) d[k] = sphere.row(faces(f, static_cast<int>(k))).transpose().cast<long double>() - p;
  LongVector w(p.dot(d[1].cross(d[2])), p.dot(d[2].cross(d[0])), p.dot(d[0].cross(d[1])));
  return w / w.sum();
}

Eigen::Vector3d random_weights(Random& random) {
  double u = random.uniform(), v = random.uniform();
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return {1 - u - v, u, v};
}

Eigen::Vector3d point_at(const Points& sphere, const Triangles& faces, Eigen::Index f, const Eigen::Vector3d& weights) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) sum += weights[k] * sphere.row(faces(f, k)).transpose();
  return sum.normalized();
}

void expect_weights(const Location& location) {
  EXPECT_GE(location.bary.minCoeff(), 0);
  EXPECT_NEAR(location.bary.sum(), 1, 1e-15);
}

TEST(PointLocation, RecoversBarycentricPointsOfKnownTriangles) {
  Random random(1);
  for (const TriMesh& mesh : {test::octahedron(), icosphere(0), icosphere(3)}) {
    const Points sphere = test::rotated(mesh.vertices, random.rotation()).rowwise().normalized();
    const PointLocation location(sphere, mesh.faces);
    for (int i = 0; i < 3000; ++i) {
      const std::int32_t face = random.below(static_cast<std::int32_t>(mesh.face_count()));
      const Eigen::Vector3d weights = random_weights(random);
      const Location found = location.locate(point_at(sphere, mesh.faces, face, weights));
      if (weights.minCoeff() > 1e-12) {
        ASSERT_EQ(found.face, face) << i;
      }
      expect_weights(found);
      // Measured: 1e-15.
      if (found.face == face) {
        ASSERT_LT((found.bary - weights).cwiseAbs().maxCoeff(), 1e-13);
      }
    }
  }
}

/// Rings round a point, each of half the radius of the one before, down to 2e-9: triangles of every size.
TriMesh graded_sphere() {
  constexpr int around = 12, rings = 31;
  TriMesh mesh;
  mesh.vertices.resize(rings * around + 2, 3);
  const Eigen::Matrix3d turn = Random(2).rotation();
  const auto place = [&](Eigen::Index v, double colatitude, double longitude) {
    mesh.vertices.row(v) = (turn * sphere_point(colatitude, longitude)).normalized().transpose();
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int i = 0; i < around; ++i)
      place(ring * around + i, 2 * std::pow(0.5, ring), 2 * std::numbers::pi * (i + 0.5 * (ring % 2)) / around);
  const int centre = rings * around, far = centre + 1;
  place(centre, 0, 0);
  place(far, std::numbers::pi, 0);
  mesh.faces.resize(2 * rings * around, 3);
  Eigen::Index f = 0;
  for (int i = 0; i < around; ++i) {
    const int next = (i + 1) % around, last = (rings - 1) * around;
    mesh.faces.row(f++) << far, next, i;
    mesh.faces.row(f++) << centre, last + i, last + next;
    for (int ring = 0; ring + 1 < rings; ++ring) {
      // The inner ring stands half a step ahead of the outer one, or behind it.
      const int outer = ring * around, inner = outer + around, a = ring % 2 == 0 ? i : next, b = ring % 2 == 0 ? next : i;
      mesh.faces.row(f++) << outer + i, outer + next, inner + a;
      mesh.faces.row(f++) << inner + i, outer + b, inner + next;
    }
  }
  for (Eigen::Index face = 0; face < f; ++face)
    if (orientation(mesh.vertices.row(mesh.faces(face, 0)), mesh.vertices.row(mesh.faces(face, 1)),
                    mesh.vertices.row(mesh.faces(face, 2))) < 0)
      std::swap(mesh.faces(face, 1), mesh.faces(face, 2));
  return mesh;
}

TEST(PointLocation, ResolvesTrianglesOfOneHundredMillionth) {
  const TriMesh mesh = graded_sphere();
  ASSERT_TRUE(flipped_faces(mesh.vertices, mesh.faces).empty());
  ASSERT_NEAR(total_solid_angle(mesh.vertices, mesh.faces), 4 * std::numbers::pi, 1e-12);
  const PointLocation location(mesh.vertices, mesh.faces);
  Random random(3);
  int tiny = 0;
  for (int i = 0; i < 5000; ++i) {
    const std::int32_t face = random.below(static_cast<std::int32_t>(mesh.face_count()));
    const Eigen::Vector3d p =
        point_at(mesh.vertices, mesh.faces, face, 0.98 * random_weights(random) + Eigen::Vector3d::Constant(0.02 / 3));
    const Location found = location.locate(p);
    const double size = (mesh.vertices.row(mesh.faces(face, 0)) - mesh.vertices.row(mesh.faces(face, 1))).norm();
    // p itself is rounded to 1e-16, which is 1e-7 of the smallest triangles, so the truth is what its own doubles say.
    const LongVector exact = exact_weights(mesh.vertices, mesh.faces, face, p);
    if (exact.minCoeff() < 1e-9L) continue;
    ASSERT_EQ(found.face, face) << "edge length " << size;
    expect_weights(found);
    // Measured: 2e-16.
    ASSERT_LT((found.bary.cast<long double>() - exact).cwiseAbs().maxCoeff(), 1e-13L) << "edge length " << size;
    tiny += size < 1e-8 ? 1 : 0;
  }
  EXPECT_GT(tiny, 300);
}

TEST(PointLocation, AgreesWithTryingEveryFace) {
  std::vector<TriMesh> meshes{test::octahedron(), icosphere(4), graded_sphere()};
  boost(meshes[1].vertices, 0.8 * Eigen::Vector3d(0.6, 0, 0.8));  // sizes from 0.6 to 0.008
  Random random(4);
  for (const TriMesh& mesh : meshes) {
    ASSERT_TRUE(flipped_faces(mesh.vertices, mesh.faces).empty());
    const PointLocation location(mesh.vertices, mesh.faces);
    const Eigen::Vector3d crowd = mesh.vertices.row(mesh.vertex_count() - 2).transpose();
    for (int i = 0; i < 400; ++i) {
      const Eigen::Vector3d p = (i % 2 == 0 ? 1.0 : 0.0) * crowd + std::pow(10.0, -random.uniform(0, 9)) * random.unit_vector();
      const Eigen::Vector3d q = p.normalized();
      std::int32_t best = -1;
      long double depth = -1;
      for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
        const LongVector w = exact_weights(mesh.vertices, mesh.faces, f, q);
        if (q.dot(point_at(mesh.vertices, mesh.faces, f, Eigen::Vector3d::Constant(1.0 / 3))) > 0 && w.minCoeff() > depth) {
          depth = w.minCoeff();
          best = static_cast<std::int32_t>(f);
        }
      }
      const Location found = location.locate(q);
      if (depth > 1e-12L) {
        ASSERT_EQ(found.face, best) << i;
      }
      EXPECT_LT((point_at(mesh.vertices, mesh.faces, found.face, found.bary) - q).norm(), 1e-14);
    }
  }
}

TEST(PointLocation, FindsVerticesExactly) {
  for (const TriMesh& mesh : {test::octahedron(), icosphere(3)}) {
    const PointLocation location(mesh.vertices, mesh.faces);
    for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
      const Location found = location.locate(mesh.vertices.row(v));
      Eigen::Index corner = 0;
      EXPECT_EQ(found.bary.maxCoeff(&corner), 1);
      EXPECT_EQ(mesh.faces(found.face, corner), v);
      EXPECT_EQ(found.bary.sum(), 1);
    }
  }
}

TEST(PointLocation, GivesPointsOfAnEdgeToOneOfItsFaces) {
  const TriMesh mesh = icosphere(2);
  const Points sphere = test::rotated(mesh.vertices, Random(4).rotation()).rowwise().normalized();
  const PointLocation location(sphere, mesh.faces);
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3);
      const Eigen::Vector3d p = (0.3 * sphere.row(a) + 0.7 * sphere.row(b)).transpose().normalized();
      const Location found = location.locate(p);
      double on_edge = 0;
      for (int j = 0; j < 3; ++j)
        if (mesh.faces(found.face, j) == a || mesh.faces(found.face, j) == b) on_edge += found.bary[j];
      EXPECT_NEAR(on_edge, 1, 1e-14);
      expect_weights(found);
    }
}

TEST(PointLocation, PrefersTheUprightFaceOfAFold) {
  TriMesh mesh = icosphere(2);
  // A vertex pulled over its neighbours turns faces over, so that some points are covered three times.
  mesh.vertices.row(20) = (mesh.vertices.row(20) + 0.6 * Eigen::RowVector3d(0.3, -0.8, 0.5)).normalized();
  const std::vector<std::int32_t> flipped = flipped_faces(mesh.vertices, mesh.faces);
  ASSERT_FALSE(flipped.empty());
  const PointLocation location(mesh.vertices, mesh.faces);
  for (const std::int32_t f : flipped) {
    const Eigen::Vector3d p = point_at(mesh.vertices, mesh.faces, f, Eigen::Vector3d::Constant(1.0 / 3));
    const Location found = location.locate(p);
    EXPECT_NE(found.face, f);
    EXPECT_LT((point_at(mesh.vertices, mesh.faces, found.face, found.bary) - p).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace spherematch
