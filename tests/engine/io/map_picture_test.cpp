#include "engine/io/map_picture.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/io/renderer.h"
#include "tests/engine/io/pictures.h"
#include "tests/engine/io/some_maps.h"

namespace spherematch::test {
namespace {

Image picture(const PolygonMesh& source, const PolygonMesh& target) {
  const Surface from = repair(source, RepairMode::fill);
  const Surface to = repair(target, RepairMode::fill);
  return decoded_png(encode_png(identity_map(from), from, to));
}

using Pixel = Eigen::Vector3i;
Pixel pixel(Image& image, int x, int y) { return {image.at(x, y)[0], image.at(x, y)[1], image.at(x, y)[2]}; }
const Pixel white(255, 255, 255);

/// The share of the covered pixels of either half whose colour differs by more than `tolerance` from the same place in the other.
double difference_of_halves(Image& image, int tolerance) {
  int covered = 0;
  int different = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.height; ++x) {
      const Pixel left = pixel(image, x, y);
      const Pixel right = pixel(image, image.height + x, y);
      if (left == white && right == white) continue;
      ++covered;
      if ((left - right).cwiseAbs().maxCoeff() > tolerance) ++different;
    }
  }
  EXPECT_GT(covered, image.height * image.height / 10);
  return static_cast<double>(different) / covered;
}

TEST(MapPicture, ShowsTheSameTwiceForTheIdentity) {
  const PolygonMesh mesh = polygons(creature(4));
  Image image = picture(mesh, mesh);
  EXPECT_EQ(image.width, 1200);
  EXPECT_EQ(image.height, 600);
  EXPECT_EQ(pixel(image, 0, 0), white);
  EXPECT_EQ(pixel(image, 1199, 599), white);
  EXPECT_LT(difference_of_halves(image, 2), 0.002);
}

TEST(MapPicture, ATurnedTargetIsSeenFromTheCorrespondingSide) {
  const PolygonMesh mesh = polygons(creature(4));
  Eigen::Matrix3d cycle;  // x to y, y to z, z to x: the axes stay axes, so that the target stands upright by itself
  cycle << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  const PolygonMesh turned = polygons(transformed(creature(4), 3, cycle, {7, 8, 9}));
  Image image = picture(mesh, turned);
  EXPECT_LT(difference_of_halves(image, 2), 0.01);
}

TEST(MapPicture, CorrespondingPointsShareTheirColorAndOthersDoNot) {
  const PolygonMesh mesh = polygons(creature(4));
  const Surface surface = repair(mesh, RepairMode::none);
  Correspondence wrong = identity_map(surface);
  for (Eigen::Index v = 0; v < wrong.corners.rows(); ++v) {  // all to one point
    wrong.corners.row(v) = surface.uploaded_corners.row(0);
    wrong.bary.row(v) = Eigen::RowVector3f::Unit(0);
  }
  Image image = decoded_png(encode_png(wrong, surface, surface));
  EXPECT_GT(difference_of_halves(image, 30), 0.5);
}

TEST(MapPicture, WhatHasNoImageIsGray) {
  // As if repair had put the upper part of a sphere over a hole.
  Surface surface = repair(polygons(icosphere(4)), RepairMode::none);
  const auto added = [&](std::int32_t v) { return surface.mesh.vertices(v, 2) > 0.5; };
  for (std::int32_t v = 0; v < surface.mesh.vertex_count(); ++v)
    if (added(v)) surface.surface_vertex[static_cast<std::size_t>(v)] = -1;
  surface.uploaded_corners = surface.uploaded_corners.unaryExpr([&](std::int32_t v) { return added(v) ? -1 : v; }).eval();
  Image image = decoded_png(encode_png(identity_map(surface), surface, surface));
  int gray = 0;
  for (int y = 0; y < 600; ++y) {
    for (int x = 0; x < 600; ++x) {
      const Pixel p = pixel(image, x, y);
      if (p != white && p.maxCoeff() - p.minCoeff() <= 1) ++gray;
    }
  }
  EXPECT_GT(gray, 500);
}

TEST(MapPicture, AMapOfAnotherSourceIsRefused) {
  const Surface small = repair(polygons(icosphere(1)), RepairMode::none);
  const Surface large = repair(polygons(icosphere(2)), RepairMode::none);
  EXPECT_THROW((void)encode_png(identity_map(small), large, small), std::invalid_argument);
}

TEST(MapPicture, BytesDependOnTheArgumentsAlone) {
  const Surface surface = repair(polygons(creature(3)), RepairMode::none);
  EXPECT_EQ(encode_png(identity_map(surface), surface, surface), encode_png(identity_map(surface), surface, surface));
}

TEST(MapPicture, SizeAndPlaceOfTheCoordinatesDoNotMatter) {
  const Surface surface = repair(polygons(creature(3)), RepairMode::none);
  Image expected = decoded_png(encode_png(identity_map(surface), surface, surface));
  for (const auto& [scale, shift] : {std::pair{1e50, 0.0}, {1e-50, 0.0}, {1.0, 1e6}}) {
    const PolygonMesh mesh = polygons(transformed(creature(3), scale, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Constant(shift)));
    Image image = picture(mesh, mesh);
    int different = 0;
    for (int y = 0; y < 600; ++y)
      for (int x = 0; x < 1200; ++x) different += (pixel(image, x, y) - pixel(expected, x, y)).cwiseAbs().maxCoeff() > 2;
    EXPECT_LT(different, 300) << scale;
  }
}

TEST(Renderer, ASphereCoversItsDisc) {
  const TriMesh sphere = icosphere(4);
  const Points paint = Points::Constant(sphere.vertex_count(), 3, 0.5);
  Image image(200, 100);
  render({sphere, paint, ViewAxes::Identity(), Eigen::Vector3d::Zero(), 40}, image, 100);
  double covered = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      EXPECT_EQ(pixel(image, x, y), white);
      covered += pixel(image, 100 + x, y) != white;
      EXPECT_TRUE(pixel(image, 100 + x, y) == white || std::hypot(x + 0.5 - 50, y + 0.5 - 50) < 41) << x << ' ' << y;
    }
  }
  EXPECT_NEAR(covered, M_PI * 40 * 40, 0.06 * M_PI * 40 * 40);  // pixels at the rim count whole
}

TEST(Renderer, TheNearerSurfaceHidesTheFarther) {
  const TriMesh near = transformed(icosphere(3), 0.5, Eigen::Matrix3d::Identity(), {0, 0, 2});
  for (const bool near_first : {true, false}) {
    const TriMesh both = near_first ? joined(near, icosphere(3)) : joined(icosphere(3), near);
    Points paint = Points::Zero(both.vertex_count(), 3);
    for (Eigen::Index v = 0; v < both.vertex_count(); ++v) paint(v, both.vertices(v, 2) > 1.2 ? 0 : 2) = 1;  // near red, far blue
    Image image(100, 100);
    render({both, paint, ViewAxes::Identity(), Eigen::Vector3d::Zero(), 40}, image, 0);
    EXPECT_GT(pixel(image, 50, 50).x(), pixel(image, 50, 50).z() + 50);
    EXPECT_GT(pixel(image, 50, 15).z(), pixel(image, 50, 15).x() + 50);
    // Seen from the other side the small one is behind.
    ViewAxes behind = ViewAxes::Identity();
    behind.row(0) *= -1;
    behind.row(2) *= -1;
    Image other(100, 100);
    render({both, paint, behind, Eigen::Vector3d::Zero(), 40}, other, 0);
    EXPECT_GT(pixel(other, 50, 50).z(), pixel(other, 50, 50).x() + 50);
  }
}

TEST(Renderer, OnlyTwoSidedScenesShowFacesFromBehind) {
  TriMesh inside_out = icosphere(3);
  inside_out.faces.col(1).swap(inside_out.faces.col(2));
  inside_out.faces.conservativeResize(1, 3);  // one face, so that nothing else is seen
  const Points paint = Points::Constant(inside_out.vertex_count(), 3, 0.5);
  ViewAxes axes = ViewAxes::Identity();
  axes.row(2) = inside_out.vertices.row(inside_out.faces(0, 0)).normalized();
  axes.row(0) = axes.row(2).cross(Eigen::RowVector3d::Unit(0)).normalized();
  axes.row(1) = axes.row(2).cross(axes.row(0));
  const Eigen::Vector3d center = inside_out.vertices.row(inside_out.faces(0, 0)).transpose();
  for (const bool two_sided : {false, true}) {
    Image image(100, 100);
    render({inside_out, paint, axes, center, 200, Paint::color, two_sided}, image, 0);
    int covered = 0;
    for (int y = 0; y < 100; ++y)
      for (int x = 0; x < 100; ++x) covered += pixel(image, x, y) != white;
    EXPECT_EQ(covered > 100, two_sided) << covered;
  }
}

TEST(Renderer, TheCheckerboardRepeatsAndItsFieldsDiffer) {
  for (const auto& [u, v] : {std::pair{0.05F, 0.05F}, {0.3F, 0.7F}, {0.99F, 0.2F}}) {
    EXPECT_LT((checker_color(u, v) - checker_color(u + 1, v - 2)).norm(), 1e-4F);
    EXPECT_GT((checker_color(u, v) - checker_color(u + 0.125F, v)).norm(), 0.05F);
    EXPECT_GT((checker_color(u, v) - checker_color(u, v + 0.125F)).norm(), 0.05F);
    EXPECT_TRUE((checker_color(u, v).array() >= 0).all() && (checker_color(u, v).array() <= 1).all());
  }
}

}  // namespace
}  // namespace spherematch::test
