#include "engine/mesh/decimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/mesh/topology.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

Eigen::Vector3d point_of(const DecimatedMesh& decimated, const SurfacePoint& place) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    point += place.weights[static_cast<std::size_t>(k)] * decimated.mesh.vertices.row(decimated.mesh.faces(place.face, k)).transpose();
  return point;
}

void expect_closed_sphere(const TriMesh& mesh) {
  EXPECT_EQ(mesh.face_count(), 2 * mesh.vertex_count() - 4);
  EXPECT_EQ(euler_characteristic(mesh.faces), 2);
  EXPECT_GE(face_neighbours(mesh.faces).minCoeff(), 0);
  const VertexFaces around = vertex_faces(mesh.faces, mesh.vertex_count());
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) EXPECT_GE(around.of(v).size(), 3U);
  EXPECT_GT(test::signed_volume(mesh), 0);
}

TEST(Decimate, KeepsTheShapeWithFewerVertices) {
  const TriMesh body = test::creature(5);
  const auto decimated = decimate(body, 1000);
  ASSERT_TRUE(decimated.has_value());
  EXPECT_EQ(decimated->mesh.vertex_count(), 1000);
  expect_closed_sphere(decimated->mesh);
  const double size = std::sqrt(test::total_area(body));
  // The middle of an edge lies inside of a convex place. Measured: 2.1 percent of the volume lost.
  EXPECT_NEAR(test::total_area(decimated->mesh), size * size, 0.04 * size * size);
  EXPECT_NEAR(test::signed_volume(decimated->mesh), test::signed_volume(body), 0.04 * test::signed_volume(body));
  ASSERT_EQ(decimated->places.size(), static_cast<std::size_t>(body.vertex_count()));
  double farthest = 0;
  for (Eigen::Index v = 0; v < body.vertex_count(); ++v) {
    const SurfacePoint& place = decimated->places[static_cast<std::size_t>(v)];
    ASSERT_GE(place.face, 0);
    ASSERT_LT(place.face, decimated->mesh.face_count());
    double sum = 0;
    for (const double weight : place.weights) {
      EXPECT_GE(weight, 0);
      sum += weight;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    farthest = std::max(farthest, (point_of(*decimated, place) - body.vertices.row(v).transpose()).norm());
  }
  EXPECT_LT(farthest, 0.02 * size);
}

TEST(Decimate, IsDeterministicAndDoesNotDependOnSizeAndPlace) {
  const TriMesh body = test::creature(4);
  const auto one = decimate(body, 600), again = decimate(body, 600);
  ASSERT_TRUE(one && again);
  EXPECT_TRUE(one->mesh.vertices == again->mesh.vertices);
  EXPECT_TRUE(one->mesh.faces == again->mesh.faces);
  for (const double scale : {std::ldexp(1.0, -300), std::ldexp(1.0, 300)}) {
    const auto other = decimate(test::transformed(body, scale, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()), 600);
    ASSERT_TRUE(other.has_value());
    EXPECT_TRUE(other->mesh.faces == one->mesh.faces);
    EXPECT_TRUE(other->mesh.vertices / scale == one->mesh.vertices);
  }
}

TEST(Decimate, LeavesSmallMeshesAlone) {
  const TriMesh body = test::creature(3);
  EXPECT_FALSE(decimate(body, 642).has_value());
  EXPECT_FALSE(decimate(body, 700).has_value());
  EXPECT_TRUE(decimate(body, 641).has_value());
}

TEST(Decimate, PlacesStayOnTheirSideOfAThinSheet) {
  // Nearer to each other than the edges are long, by far: the nearest point of all is often on the other side.
  const TriMesh plate = test::ellipsoid(5, {1, 1, 0.001});
  const auto decimated = decimate(plate, 1000);
  ASSERT_TRUE(decimated.has_value());
  int wrong = 0, seen = 0;
  for (Eigen::Index v = 0; v < plate.vertex_count(); ++v) {
    if (std::abs(plate.vertices(v, 2)) < 0.0005) continue;
    ++seen;
    const std::int32_t face = decimated->places[static_cast<std::size_t>(v)].face;
    Eigen::Vector3d p[3];
    for (int k = 0; k < 3; ++k) p[k] = decimated->mesh.vertices.row(decimated->mesh.faces(face, k));
    wrong += (p[1] - p[0]).cross(p[2] - p[0])[2] * plate.vertices(v, 2) < 0 ? 1 : 0;
  }
  EXPECT_GT(seen, 5000);
  EXPECT_EQ(wrong, 0);
}

TEST(Decimate, DoesNotTryWhatWouldTakeQuadraticTime) {
  constexpr int kRim = 50'000;
  TriMesh bipyramid;
  bipyramid.vertices.resize(kRim + 2, 3);
  bipyramid.faces.resize(2 * kRim, 3);
  for (int i = 0; i < kRim; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRim;
    bipyramid.vertices.row(i) << std::cos(angle), std::sin(angle), 0;
    bipyramid.faces.row(2 * i) << i, (i + 1) % kRim, kRim;
    bipyramid.faces.row(2 * i + 1) << (i + 1) % kRim, i, kRim + 1;
  }
  bipyramid.vertices.row(kRim) << 0, 0, 1;
  bipyramid.vertices.row(kRim + 1) << 0, 0, -1;
  EXPECT_FALSE(decimate(bipyramid, 1000).has_value());
}

}  // namespace
}  // namespace spherematch
