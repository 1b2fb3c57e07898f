#include "engine/register/mirror.h"

#include <gtest/gtest.h>

#include "engine/register/composition.h"
#include "engine/sphere/orientation.h"
#include "engine/sphere/rasterizer.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

Points directions(const TriMesh& mesh) { return mesh.vertices.rowwise().normalized(); }

TEST(Mirror, FacesFaceOutwardAgain) {
  const TriMesh body = test::creature(3);
  const Points sphere = directions(body);
  ASSERT_TRUE(flipped_faces(sphere, body.faces).empty());
  EXPECT_TRUE(flipped_faces(mirrored_points(sphere), mirrored_faces(body.faces)).empty());
  EXPECT_EQ(static_cast<Eigen::Index>(flipped_faces(mirrored_points(sphere), body.faces).size()), body.face_count());
  EXPECT_TRUE(mirrored_points(mirrored_points(sphere)) == sphere);
  EXPECT_TRUE(mirrored_faces(mirrored_faces(body.faces)) == body.faces);
  EXPECT_TRUE(sphere * mirror_matrix() == mirrored_points(sphere));
}

TEST(Mirror, AGridIsThatOfTheMirroredSurface) {
  const TriMesh body = test::creature(3);
  const Points sphere = directions(body);
  const Eigen::MatrixXd signal = body.vertices.col(0) + 2 * body.vertices.col(1) + body.vertices.col(2).cwiseAbs2();
  const Eigen::MatrixXf grid = rasterize_signals(sphere, body.faces, signal, 32).front().matrix().cast<float>();
  const Eigen::MatrixXf mirrored =
      rasterize_signals(mirrored_points(sphere), mirrored_faces(body.faces), signal, 32).front().matrix().cast<float>();
  EXPECT_LT((mirrored_grid(grid) - mirrored).cwiseAbs().maxCoeff(), 1e-6 * grid.cwiseAbs().maxCoeff());
  EXPECT_GT((grid - mirrored).cwiseAbs().maxCoeff(), 0.1 * grid.cwiseAbs().maxCoeff());
}

TEST(Mirror, ALocationIsTheSamePoint) {
  const TriMesh body = test::creature(3);
  const Points sphere = directions(body), there = mirrored_points(sphere), queries = directions(test::icosphere(2));
  const Triangles faces = mirrored_faces(body.faces);
  const std::vector<Location> plain = locate_all(queries, PointLocation(sphere, body.faces));
  const std::vector<Location> mirrored = locate_all(mirrored_points(queries), PointLocation(there, faces));
  const auto point = [&sphere, &body](const Location& location) {
    Eigen::Vector3d result = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) result += location.bary[k] * sphere.row(body.faces(location.face, k)).transpose();
    return result;
  };
  for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_LT((point(plain[i]) - point(mirrored_location(mirrored[i]))).norm(), 1e-12) << i;
}

}  // namespace
}  // namespace spherematch
