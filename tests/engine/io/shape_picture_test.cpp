#include "engine/io/shape_picture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "tests/engine/io/pictures.h"
#include "tests/engine/io/some_maps.h"

namespace spherematch::test {
namespace {

Image thumbnail(const PolygonMesh& mesh, int size = 128) { return decoded_png(encode_thumbnail(mesh, size), Background::transparent); }

/// The share of the picture that is not background, pixel by pixel as far as it is covered.
double covered_share(Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += image.at(x, y)[3] / 255.0;
  return sum / (image.width * image.height);
}

/// How many pixels differ by more than a little.
int differences(Image& a, Image& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) count += std::abs(int{a.pixels[i]} - int{b.pixels[i]}) > 4;
  return count;
}

TEST(ShapePicture, ASphereFillsTheSquareOnATransparentBackground) {
  Image image = thumbnail(polygons(icosphere(4)));
  EXPECT_EQ(image.width, 128);
  EXPECT_EQ(image.height, 128);
  for (const auto& [x, y] : {std::pair{0, 0}, {127, 0}, {0, 127}, {127, 127}, {64, 1}}) EXPECT_EQ(image.at(x, y)[3], 0);
  EXPECT_EQ(image.at(64, 64)[3], 255);
  const double radius = (128 - 2 * 4) / 2.0;
  EXPECT_NEAR(covered_share(image), M_PI * radius * radius / (128 * 128), 0.01);
}

TEST(ShapePicture, IsVisibleOnWhiteAndOnBlack) {
  Image image = thumbnail(polygons(creature(4)));
  double sum = 0;
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y)[3] < 255) continue;
      sum += (image.at(x, y)[0] + image.at(x, y)[1] + image.at(x, y)[2]) / 3.0;
      ++count;
    }
  }
  EXPECT_GT(sum / count, 80);
  EXPECT_LT(sum / count, 190);
}

TEST(ShapePicture, TheEdgeIsSmooth) {
  Image image = thumbnail(polygons(icosphere(4)));
  int partly = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto* pixel = image.at(x, y);
      if (pixel[3] == 0 || pixel[3] == 255) continue;
      ++partly;
      EXPECT_GT(pixel[0] + pixel[1] + pixel[2], 100) << "the colour of the shape, not mixed with a background";
    }
  }
  EXPECT_GT(partly, 150);
}

TEST(ShapePicture, AViewpointTurnsThePicture) {
  TriMesh stick = transformed(icosphere(3), 1, Eigen::Vector3d(1, 0.2, 0.2).asDiagonal().toDenseMatrix(), Eigen::Vector3d::Zero());
  const auto width_and_height = [&](const Eigen::Vector3d& up, const Eigen::Vector3d& front) {
    Image image = decoded_png(encode_thumbnail(polygons(stick), 64, Viewpoint{up, front}), Background::transparent);
    std::array<int, 2> seen{0, 0};
    for (int i = 0; i < 64; ++i) {
      seen[0] += image.at(i, 32)[3] > 0;
      seen[1] += image.at(32, i)[3] > 0;
    }
    return seen;
  };
  const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_GT(width_and_height(y, z)[0], 3 * width_and_height(y, z)[1]);
  EXPECT_GT(width_and_height(x, z)[1], 3 * width_and_height(x, z)[0]);
  EXPECT_LT(width_and_height(y, x)[0], 2 * width_and_height(y, x)[1]);
}

TEST(ShapePicture, EverySizeInRangeAndNoOther) {
  const PolygonMesh mesh = polygons(icosphere(2));
  for (const int size : {least_thumbnail, 17, largest_thumbnail}) EXPECT_EQ(thumbnail(mesh, size).width, size);
  for (const int size : {0, least_thumbnail - 1, largest_thumbnail + 1})
    EXPECT_THROW((void)encode_thumbnail(mesh, size), std::invalid_argument);
}

TEST(ShapePicture, SizeAndPlaceOfTheCoordinatesDoNotMatter) {
  Image expected = thumbnail(polygons(creature(3)));
  for (const auto& [scale, shift] : {std::pair{1e50, 0.0}, {1e-50, 0.0}, {1.0, 1e6}}) {
    Image image = thumbnail(polygons(transformed(creature(3), scale, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Constant(shift))));
    EXPECT_LT(differences(image, expected), 100) << scale;
  }
}

TEST(ShapePicture, FacesThatLookInwardAreDrawnAsWell) {
  Image expected = thumbnail(polygons(creature(3)));
  TriMesh inside_out = creature(3);
  inside_out.faces.col(1).swap(inside_out.faces.col(2));
  Image image = thumbnail(polygons(inside_out));
  EXPECT_LT(differences(image, expected), 100);
}

TEST(ShapePicture, AnOpenMeshIsWholeToSee) {
  const TriMesh whole = icosphere(3);
  TriMesh half = whole;  // what is left shows its inside, wherever the picture is taken from
  half.faces.conservativeResize(whole.face_count() / 2, 3);
  Image image = thumbnail(polygons(half));
  EXPECT_GT(covered_share(image), 0.2);
}

TEST(ShapePicture, AVertexWithoutAFaceDoesNotMatter) {
  PolygonMesh stray = polygons(creature(3));
  stray.vertices.conservativeResize(stray.vertices.rows() + 1, 3);
  stray.vertices.bottomRows(1).setConstant(1e5);
  EXPECT_EQ(encode_thumbnail(stray, 128), encode_thumbnail(polygons(creature(3)), 128));
}

TEST(ShapePicture, PolygonsAreTriangulated) {
  Image image = thumbnail(cube());
  EXPECT_GT(covered_share(image), 0.4);
}

TEST(ShapePicture, WhatHasNoAreaIsRefused) {
  PolygonMesh flat = polygons(tetrahedron());
  flat.vertices.setOnes();
  EXPECT_THROW((void)encode_thumbnail(flat, 64), std::invalid_argument);
  flat.vertices.setZero();
  flat.vertices.col(0) << 0, 1, 2, 3;
  EXPECT_THROW((void)encode_thumbnail(flat, 64), std::invalid_argument);
}

TEST(ShapePicture, BytesDependOnTheArgumentsAlone) {
  EXPECT_EQ(encode_thumbnail(polygons(creature(3)), 64), encode_thumbnail(polygons(creature(3)), 64));
}

}  // namespace
}  // namespace spherematch::test
