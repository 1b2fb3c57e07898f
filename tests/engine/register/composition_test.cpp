#include "engine/register/composition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/engine/sphere/spheres.h"
#include "tests/support/meshes.h"
#include "tests/support/shapes.h"

namespace spherematch {
namespace {

using test::icosphere;
using test::Random;
using test::verbatim_surface;

/// An octahedron from an upload of nine vertices: 0 dropped, 3 and 7 welded to surface vertex 2 (the pole), the others in
/// reverse order. Two faces meet the pole at upload 3, two at upload 7.
Surface patched_octahedron() {
  Surface surface;
  surface.mesh = test::octahedron();
  surface.surface_vertex = {-1, 5, 4, 2, 3, 1, 0, 2, -1};
  const std::vector<std::int32_t> uploaded{6, 5, 3, 4, 2, 1};
  surface.uploaded_corners = surface.mesh.faces;
  for (Eigen::Index i = 0; i < surface.uploaded_corners.size(); ++i)
    surface.uploaded_corners.data()[i] = uploaded[static_cast<std::size_t>(surface.mesh.faces.data()[i])];
  for (const Eigen::Index f : {1, 2})
    for (int k = 0; k < 3; ++k)
      if (surface.mesh.faces(f, k) == 2) surface.uploaded_corners(f, k) = 7;
  surface.uploaded_faces = 8;
  surface.report.dropped_vertices = 2;
  surface.report.welded_vertices = 1;
  return surface;
}

Eigen::Vector3d image(const Surface& target, const Correspondence& map, Eigen::Index row) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const std::int32_t v = target.surface_vertex[static_cast<std::size_t>(map.corners(row, k))];
    sum += static_cast<double>(map.bary(row, k)) * target.mesh.vertices.row(v).transpose();
  }
  return sum;
}

TEST(Compose, OfTheIdentityIsTheIdentity) {
  const TriMesh body = test::creature(3);
  const Surface surface = verbatim_surface(body);
  const Points sphere = body.vertices.rowwise().normalized();
  const Correspondence map = compose(surface, surface, locate_all(sphere, PointLocation(sphere, body.faces)));
  ASSERT_EQ(static_cast<Eigen::Index>(map.vertex.size()), body.vertex_count());
  for (std::int32_t v = 0; v < body.vertex_count(); ++v) {
    EXPECT_EQ(map.vertex[static_cast<std::size_t>(v)], v);
    Eigen::Index corner = 0;
    EXPECT_EQ(map.bary.row(v).maxCoeff(&corner), 1.0F);
    EXPECT_EQ(map.corners(v, corner), v);
    EXPECT_EQ(map.bary.row(v).sum(), 1.0F);
  }
}

TEST(Compose, SpeaksOfUploadedVertices) {
  const Surface surface = patched_octahedron();
  const Points& sphere = surface.mesh.vertices;
  const Correspondence map = compose(surface, surface, locate_all(sphere, PointLocation(sphere, surface.mesh.faces)));
  ASSERT_EQ(map.vertex.size(), 9U);
  ASSERT_EQ(map.corners.rows(), 9);
  ASSERT_EQ(map.bary.rows(), 9);
  for (const Eigen::Index dropped : {0, 8}) {
    EXPECT_EQ(map.vertex[static_cast<std::size_t>(dropped)], -1);
    EXPECT_TRUE((map.corners.row(dropped).array() == -1).all());
    EXPECT_TRUE((map.bary.row(dropped).array() == 0).all());
  }
  for (const std::int32_t u : {1, 2, 4, 5, 6}) EXPECT_EQ(map.vertex[static_cast<std::size_t>(u)], u);
  // Both welded vertices have the same image, under the name that the face found has for it.
  EXPECT_TRUE(map.vertex[3] == 3 || map.vertex[3] == 7);
  EXPECT_EQ(map.vertex[7], map.vertex[3]);
  EXPECT_TRUE(map.corners.row(7) == map.corners.row(3));
  for (const Eigen::Index u : {1, 2, 3, 4, 5, 6, 7}) {
    const std::int32_t v = surface.surface_vertex[static_cast<std::size_t>(u)];
    EXPECT_EQ(image(surface, map, u), surface.mesh.vertices.row(v).transpose());
    // The three corners are those of one uploaded face.
    bool known = false;
    for (Eigen::Index f = 0; f < 8; ++f) known = known || map.corners.row(u) == surface.uploaded_corners.row(f);
    EXPECT_TRUE(known);
  }
}

TEST(Compose, BreaksTiesByTheLowestUploadedIndex) {
  const Surface source = verbatim_surface(test::octahedron());
  Surface target = patched_octahedron();
  // Face 4 has surface corners 1, 0, 5, uploaded 5, 6, 1.
  ASSERT_EQ(target.uploaded_corners.row(4), Eigen::RowVector3i(5, 6, 1));
  std::vector<Location> locations(6, {4, {1, 0, 0}});
  locations[0] = {4, {0.5, 0.5, 0}};         // as near to 5 as to 6
  locations[1] = {4, {0.25, 0.25, 0.5}};     // nearest to 1
  locations[2] = {4, {0, 0.5, 0.5}};         // 6 and 1
  locations[3] = {4, {0.5, 0.25, 0.25}};     // nearest to 5
  locations[4] = {4, {0.375, 0.25, 0.375}};  // 5 and 1
  const Correspondence map = compose(source, target, locations);
  EXPECT_EQ(map.vertex, (std::vector<std::int32_t>{5, 1, 1, 5, 1, 5}));
}

TEST(Compose, TakesTheNearestCornerByStraightDistanceNotByWeight) {
  // Face 0 is (0, 1, 2). Corner 2 has the most weight but stands so far away that the image is nearer to corner 1.
  const Surface source = verbatim_surface(test::octahedron());
  Surface target = source;
  target.mesh.vertices.row(2) << 0, 0, 10;
  const Correspondence map = compose(source, target, std::vector<Location>(6, {0, {0.06, 0.46, 0.48}}));
  std::vector<double> distances;
  for (int k = 0; k < 3; ++k) distances.push_back((image(target, map, 0) - target.mesh.vertices.row(k).transpose()).norm());
  ASSERT_EQ(std::min_element(distances.begin(), distances.end()) - distances.begin(), 1);
  EXPECT_EQ(map.vertex, std::vector<std::int32_t>(6, 1));
}

TEST(Compose, MovesImagesOnAddedPatchesToTheUploadedSurface) {
  // The pole of an icosphere was added by repair: no upload has it.
  const TriMesh mesh = icosphere(2);
  Surface target = verbatim_surface(mesh);
  const std::int32_t added = 25;
  target.surface_vertex.erase(target.surface_vertex.begin() + added);
  for (Eigen::Index i = 0; i < target.uploaded_corners.size(); ++i) {
    std::int32_t& u = target.uploaded_corners.data()[i];
    u = u == added ? -1 : (u > added ? u - 1 : u);
  }
  target.report.added_vertices = 1;
  const Surface source = verbatim_surface(mesh);
  const std::vector<Location> locations = locate_all(mesh.vertices, PointLocation(mesh.vertices, mesh.faces));
  const Correspondence map = compose(source, target, locations);
  EXPECT_GE(map.corners.minCoeff(), 0);
  EXPECT_LT(map.corners.maxCoeff(), target.uploaded_vertices());
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_NEAR(map.bary.row(v).sum(), 1, 1e-6);
    EXPECT_GE(map.bary.row(v).minCoeff(), 0);
    // The nearest point of the faces that were uploaded, found by trying a fine lattice of points on each.
    const double distance = (image(target, map, v) - mesh.vertices.row(v).transpose()).norm();
    if (v != added) {
      // A neighbour of the patch may be found on it, and is then its own nearest point.
      EXPECT_LT(distance, 1e-7) << v;
      EXPECT_EQ(map.vertex[static_cast<std::size_t>(v)], v > added ? v - 1 : v);
      continue;
    }
    double best = 10;
    for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
      if (target.uploaded_corners.row(f).minCoeff() < 0) continue;
      for (int i = 0; i <= 50; ++i)
        for (int j = 0; i + j <= 50; ++j) {
          const Eigen::RowVector3d p = (i * mesh.vertices.row(mesh.faces(f, 0)) + j * mesh.vertices.row(mesh.faces(f, 1)) +
                                        (50 - i - j) * mesh.vertices.row(mesh.faces(f, 2))) /
                                       50;
          best = std::min(best, (p - mesh.vertices.row(added)).norm());
        }
    }
    EXPECT_GT(distance, 0.1);
    EXPECT_LT(distance, best + 1e-7);
    EXPECT_GT(distance, best - 0.01);
  }
}

TEST(LocateAll, ExchangingTheSpheresInvertsTheMap) {
  const TriMesh mesh = icosphere(3);
  const Points source = test::rotated(mesh.vertices, Random(1).rotation());
  Points target = mesh.vertices;
  const PointLocation on_target(target, mesh.faces);
  const std::vector<Location> there = locate_all(source, on_target);
  ASSERT_EQ(static_cast<Eigen::Index>(there.size()), source.rows());
  for (Eigen::Index v = 0; v < source.rows(); ++v) {
    const Location& at = there[static_cast<std::size_t>(v)];
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) p += at.bary[k] * target.row(mesh.faces(at.face, k)).transpose();
    EXPECT_LT((p.normalized() - source.row(v).transpose()).norm(), 1e-14);
    // And back: the image's ray meets the source at the vertex.
    const Location back = PointLocation(source, mesh.faces).locate(p.normalized());
    double at_vertex = 0;
    for (int k = 0; k < 3; ++k)
      if (mesh.faces(back.face, k) == v) at_vertex = back.bary[k];
    EXPECT_NEAR(at_vertex, 1, 1e-12);
  }
}

}  // namespace
}  // namespace spherematch
