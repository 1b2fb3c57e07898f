// Shapes that are prepared on a decimated copy: results speak of the upload all the same.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "engine/engine.h"
#include "tests/support/meshes.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

PreprocessedShape prepared(const TriMesh& mesh, std::int32_t simplify) {
  std::ostringstream off;
  off.precision(17);
  off << "OFF\n" << mesh.vertex_count() << " " << mesh.face_count() << " 0\n" << mesh.vertices << "\n";
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) off << "3 " << mesh.faces.row(f) << "\n";
  const std::string text = off.str();
  return preprocess(read_surface(std::as_bytes(std::span(text)), "", {.simplify = simplify}), test::quick_preparation());
}

/// Valid on the upload, and how far it is from the identity, relative to the square root of the area.
double checked_error(const Correspondence& map, const TriMesh& target) {
  EXPECT_EQ(map.corners.rows(), target.vertex_count());
  double sum = 0;
  for (Eigen::Index i = 0; i < map.corners.rows(); ++i) {
    const auto corners = map.corners.row(i);
    EXPECT_TRUE(((target.faces.col(0).array() == corners[0] || target.faces.col(1).array() == corners[0] ||
                  target.faces.col(2).array() == corners[0]) &&
                 (target.faces.col(0).array() == corners[1] || target.faces.col(1).array() == corners[1] ||
                  target.faces.col(2).array() == corners[1]) &&
                 (target.faces.col(0).array() == corners[2] || target.faces.col(1).array() == corners[2] ||
                  target.faces.col(2).array() == corners[2]))
                    .any())
        << "row " << i << " spans no uploaded face";
    EXPECT_GE(map.bary.row(i).minCoeff(), 0);
    EXPECT_NEAR(map.bary.row(i).sum(), 1, 1e-6);
    EXPECT_TRUE((corners.array() == map.vertex[static_cast<std::size_t>(i)]).any());
    Eigen::RowVector3d image = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) image += static_cast<double>(map.bary(i, k)) * target.vertices.row(corners[k]);
    sum += (image - target.vertices.row(i)).norm();
  }
  return sum / static_cast<double>(map.corners.rows()) / std::sqrt(test::total_area(target));
}

class Simplify : public ::testing::Test {
 protected:
  const TriMesh body_ = test::creature(4);
  const TriMesh mirrored_ = [this] {
    TriMesh mesh = test::transformed(body_, 2, test::some_rotation(), {1, 2, 3});
    mesh.vertices.col(0) *= -1;
    mesh.faces.col(1).swap(mesh.faces.col(2));
    return mesh;
  }();
};

TEST_F(Simplify, ResultsSpeakOfTheUpload) {
  const PreprocessedShape whole = prepared(body_, 0), coarse = prepared(body_, 800);
  EXPECT_FALSE(whole.surface.decimated.has_value());
  ASSERT_TRUE(coarse.surface.decimated.has_value());
  EXPECT_EQ(coarse.surface.decimated->mesh.vertex_count(), 800);
  EXPECT_EQ(coarse.sphere.rows(), 800);
  EXPECT_EQ(coarse.eigenvectors.rows(), 800);
  EXPECT_EQ(coarse.sphere_quality.flipped, 0);
  EXPECT_EQ(coarse.seconds.front().first, "simplify");
  EXPECT_TRUE(coarse.surface.mesh.vertices == body_.vertices);

  MatchParameters parameters;
  parameters.both = true;
  for (const PreprocessedShape* source : {&whole, &coarse})
    for (const PreprocessedShape* target : {&whole, &coarse}) {
      const MatchResult result = match(*source, *target, parameters);
      EXPECT_LT(checked_error(result.map, body_), 0.02);
      EXPECT_LT(checked_error(result.reverse, body_), 0.02);
    }
}

TEST_F(Simplify, WorksWithMirrorImagesAndHints) {
  const PreprocessedShape source = prepared(body_, 800), target = prepared(mirrored_, 800);
  MatchParameters parameters;
  parameters.both = true;
  parameters.orientation = Orientation::any;
  parameters.hints = {{0, 0}, {1000, 1000}, {2500, 2500}, {1800, 1800}};
  const MatchResult result = match(source, target, parameters);
  EXPECT_TRUE(result.reversed);
  EXPECT_LT(checked_error(result.map, mirrored_), 0.02);
  EXPECT_LT(checked_error(result.reverse, body_), 0.02);
}

TEST_F(Simplify, EveryUploadedVertexHasItsPlaceOnTheSphere) {
  const PreprocessedShape shape = prepared(body_, 800);
  const Points sphere = uploaded_sphere(shape);
  ASSERT_EQ(sphere.rows(), body_.vertex_count());
  EXPECT_LT((sphere.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-14);
  // Neighbours stay neighbours: no edge is longer than a few of the coarse mesh.
  for (Eigen::Index f = 0; f < body_.face_count(); ++f)
    EXPECT_LT((sphere.row(body_.faces(f, 0)) - sphere.row(body_.faces(f, 1))).norm(), 0.5);
}

TEST_F(Simplify, IsLeftOutWhereTheSurfaceIsSmallEnough) {
  EXPECT_FALSE(prepared(test::creature(3), 642).surface.decimated.has_value());
  test::expect_refusal(ErrorCode::invalid_parameter, [this] { (void)prepared(body_, 499); });
  test::expect_refusal(ErrorCode::invalid_parameter, [this] { (void)prepared(body_, -1); });
}

}  // namespace
}  // namespace spherematch
