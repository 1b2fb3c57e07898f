#include "engine/register/point_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "engine/data/error.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

/// A sphere mapped to itself by a turn of its vertices within their faces: a map whose images are known.
class PointImagesTest : public ::testing::Test {
 protected:
  PointImagesTest() {
    surface.mesh = test::icosphere(2);
    const auto vertices = static_cast<std::int32_t>(surface.mesh.vertices.rows());
    surface.uploaded_corners = surface.mesh.faces;
    for (std::int32_t v = 0; v < vertices; ++v) surface.surface_vertex.push_back(v);
    map.corners.resize(vertices, 3);
    map.bary.resize(vertices, 3);
    for (std::int32_t v = 0; v < vertices; ++v) {
      const Eigen::Index face = v % surface.mesh.faces.rows();
      map.corners.row(v) = surface.mesh.faces.row(face);
      map.bary.row(v) << 0.5F, 0.25F, 0.25F;
      map.vertex.push_back(map.corners(v, 0));
    }
  }
  [[nodiscard]] Eigen::Vector3d image(std::int32_t v) const {
    Eigen::Vector3d result = Eigen::Vector3d::Zero();
    for (Eigen::Index k = 0; k < 3; ++k)
      result += static_cast<double>(map.bary(v, k)) * surface.mesh.vertices.row(map.corners(v, k)).transpose();
    return result;
  }
  Surface surface;
  Correspondence map;
};

TEST_F(PointImagesTest, OfAVertexItsRow) {
  const PointImages images(map, surface, surface);
  const auto found = images.of_vertex(7);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->vertex, map.vertex[7]);
  EXPECT_EQ(found->corners[1], map.corners(7, 1));
  EXPECT_EQ(found->bary[0], 0.5);
  EXPECT_LT((found->position - image(7)).norm(), 1e-15);
}

TEST_F(PointImagesTest, WithinAFaceNearTheMeanOfItsCorners) {
  PointImages images(map, surface, surface);
  const std::array<std::int32_t, 3> corners{surface.mesh.faces(5, 0), surface.mesh.faces(5, 1), surface.mesh.faces(5, 2)};
  const Eigen::Vector3d mean = 0.25 * image(corners[0]) + 0.25 * image(corners[1]) + 0.5 * image(corners[2]);
  const auto found = images.of_corners(corners, {0.25, 0.25, 0.5});
  ASSERT_TRUE(found);
  // On the surface, and no vertex of it is much nearer to the mean.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) position += found->bary[k] * surface.mesh.vertices.row(found->corners[k]).transpose();
  EXPECT_LT((found->position - position).norm(), 1e-12);
  const double nearest = (surface.mesh.vertices.rowwise() - mean.transpose()).rowwise().norm().minCoeff();
  EXPECT_LE((found->position - mean).norm(), nearest + 1e-12);
  EXPECT_NE(std::find(found->corners.begin(), found->corners.end(), found->vertex), found->corners.end());
  // At a corner exactly its row.
  EXPECT_EQ(images.of_corners(corners, {0, 1, 0})->corners[0], map.corners(corners[1], 0));
}

TEST_F(PointImagesTest, OfAPositionByItsNearestPoint) {
  PointImages images(map, surface, surface);
  const Eigen::Vector3d above = 1.5 * surface.mesh.vertices.row(3).transpose();
  const auto found = images.of_position(above);
  ASSERT_TRUE(found);
  EXPECT_LT((found->position - image(3)).norm(), 1e-6);
  EXPECT_THROW((void)images.of_position({std::numeric_limits<double>::infinity(), 0, 0}), EngineError);
}

TEST_F(PointImagesTest, DroppedAndUnknownVertices) {
  map.vertex[2] = -1;
  PointImages images(map, surface, surface);
  EXPECT_FALSE(images.of_vertex(2));
  EXPECT_FALSE(images.of_corners({2, 3, 4}, {0.5, 0.5, 0}));
  EXPECT_TRUE(images.of_corners({2, 3, 4}, {0, 0.5, 0.5}));  // the dropped one does not count
  for (const std::int32_t v : {-1, 1'000'000}) EXPECT_THROW((void)images.of_vertex(v), EngineError) << v;
  EXPECT_THROW((void)images.of_corners({0, 1, -1}, {0.5, 0.5, 0}), EngineError);
}

}  // namespace
}  // namespace spherematch
