#include "engine/mesh/closest_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <thread>

#include "engine/mesh/repair.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

Surface surface_of(const TriMesh& mesh) { return repair(test::polygons(mesh), RepairMode::fill); }

Eigen::Vector3d position(const Surface& surface, const SurfacePoint& point) {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    p += point.weights[k] * surface.mesh.vertices.row(surface.mesh.faces(point.face, static_cast<Eigen::Index>(k))).transpose();
  return p;
}

/// Distance to the nearest of many points spread over each uploaded face: never less than the true distance.
double sampled_distance(const Surface& surface, const Eigen::Vector3d& p, int steps) {
  double nearest = std::numeric_limits<double>::infinity();
  for (Eigen::Index f = 0; f < surface.mesh.face_count(); ++f) {
    if (surface.uploaded_corners.row(f).minCoeff() < 0) continue;
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const double u = static_cast<double>(i) / steps;
        const double v = static_cast<double>(j) / steps;
        const SurfacePoint sample{static_cast<std::int32_t>(f), {1 - u - v, u, v}};
        nearest = std::min(nearest, (position(surface, sample) - p).norm());
      }
  }
  return nearest;
}

Eigen::Vector3d random_point(std::mt19937_64& random) {
  const auto coordinate = [&] { return 4 * (static_cast<double>(random() >> 11) * 0x1p-53) - 2; };
  const double x = coordinate();
  const double y = coordinate();
  return {x, y, coordinate()};
}

TEST(ClosestPoint, IsNoFartherThanAnySampleOfTheSurface) {
  const Surface surface = surface_of(test::creature(2));
  const ClosestPoint closest(surface);
  std::mt19937_64 random(7);
  constexpr int steps = 12;
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d p = random_point(random);
    const SurfacePoint found = closest.query(p);
    const double distance = (position(surface, found) - p).norm();
    const double sampled = sampled_distance(surface, p, steps);
    EXPECT_LE(distance, sampled * (1 + 1e-12));
    EXPECT_GE(distance, sampled - 0.2);  // samples are that dense
    EXPECT_GE(std::min({found.weights[0], found.weights[1], found.weights[2]}), 0);
    EXPECT_NEAR(found.weights[0] + found.weights[1] + found.weights[2], 1, 1e-14);
  }
}

TEST(ClosestPoint, OfAPointOfTheSurfaceIsThePoint) {
  const Surface surface = surface_of(test::transformed(test::creature(3), 1e-3, test::some_rotation(), {5, -3, 2}));
  const ClosestPoint closest(surface);
  for (Eigen::Index f = 0; f < surface.mesh.face_count(); f += 7) {
    const SurfacePoint inside{static_cast<std::int32_t>(f), {0.2, 0.3, 0.5}};
    const SurfacePoint found = closest.query(position(surface, inside));
    EXPECT_EQ(found.face, f);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found.weights[k], inside.weights[k], 1e-9);
  }
  for (Eigen::Index v = 0; v < surface.mesh.vertex_count(); v += 5) {
    const Eigen::Vector3d p = surface.mesh.vertices.row(v).transpose();
    EXPECT_LT((position(surface, closest.query(p)) - p).norm(), 1e-14);
  }
}

TEST(ClosestPoint, LeavesOutPatchesWithAddedVertices) {
  Surface surface = surface_of(test::icosphere(2));
  const Eigen::Vector3d p = position(surface, {17, {0.3, 0.3, 0.4}});
  EXPECT_EQ(ClosestPoint(surface).query(p).face, 17);
  surface.uploaded_corners(17, 1) = -1;
  const SurfacePoint found = ClosestPoint(surface).query(p);
  EXPECT_NE(found.face, 17);
  // The nearest point lies on the rim of the face that is left out.
  EXPECT_NEAR((position(surface, found) - p).norm(), sampled_distance(surface, p, 200), 1e-4);
  EXPECT_EQ(std::count(found.weights.begin(), found.weights.end(), 0.0), 1);
}

TEST(ClosestPoint, RefusesASurfaceWithoutUploadedFaces) {
  Surface surface = surface_of(test::tetrahedron());
  surface.uploaded_corners.col(0).setConstant(-1);
  test::expect_refusal(ErrorCode::degenerate, [&] { const ClosestPoint closest(surface); });
}

TEST(ClosestPoint, AnswersTheSameFromManyThreads) {
  const Surface surface = surface_of(test::creature(3));
  const ClosestPoint closest(surface);
  std::vector<Eigen::Vector3d> points;
  std::mt19937_64 random(11);
  for (int i = 0; i < 2000; ++i) points.push_back(random_point(random));
  std::vector<std::vector<SurfacePoint>> answers(4);
  {
    std::vector<std::jthread> threads;
    for (auto& answer : answers)
      threads.emplace_back([&] {
        for (const Eigen::Vector3d& p : points) answer.push_back(closest.query(p));
      });
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const auto& answer : answers) {
      EXPECT_EQ(answer[i].face, answers[0][i].face);
      EXPECT_EQ(answer[i].weights, answers[0][i].weights);
    }
}

TEST(ClosestPoint, ManyTrianglesRoundOneVertex) {
  // A cone of 200,000 triangles: none of the trees may become as deep as that.
  constexpr std::int32_t around = 200'000;
  Points vertices(around + 2, 3);
  std::vector<std::vector<std::int32_t>> faces;
  for (std::int32_t i = 0; i < around; ++i) {
    const double angle = 2 * std::numbers::pi * i / around;
    vertices.row(i) << std::cos(angle), std::sin(angle), 0;
    faces.push_back({around, i, (i + 1) % around});
    faces.push_back({around + 1, (i + 1) % around, i});
  }
  vertices.row(around) << 0, 0, 1;
  vertices.row(around + 1) << 0, 0, -1;
  const Surface surface = repair(test::polygons(vertices, faces), RepairMode::none);
  const ClosestPoint closest(surface);
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(0, 0, -1)})
    EXPECT_NEAR((position(surface, closest.query(p)) - Eigen::Vector3d(0, 0, p.z() > 0 ? 1 : -1)).norm(), 0, 1e-12);
}

TEST(ClosestPoint, MovesWithItsTree) {
  const Surface surface = surface_of(test::icosphere(1));
  ClosestPoint first(surface);
  const SurfacePoint before = first.query({0.1, 2, 0.3});
  ClosestPoint second(std::move(first));
  first = std::move(second);
  EXPECT_EQ(first.query({0.1, 2, 0.3}).face, before.face);
}

}  // namespace
}  // namespace spherematch
