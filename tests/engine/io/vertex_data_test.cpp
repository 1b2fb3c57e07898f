#include "engine/io/vertex_data.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "engine/data/error.h"
#include "engine/io/map_picture.h"
#include "engine/io/mesh_reader.h"
#include "engine/io/renderer.h"
#include "engine/io/transfer.h"
#include "tests/engine/io/arrays.h"
#include "tests/engine/io/glb_parts.h"
#include "tests/engine/io/pictures.h"
#include "tests/engine/io/some_maps.h"
#include "tests/support/surface_checks.h"

namespace spherematch::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Correspondence identity_of(const PolygonMesh& mesh) { return identity_map(repair(mesh, RepairMode::fill)); }

/// Of an array on the eight vertices of a cube, carried to itself.
template <typename Number>
VertexDataPair on_cube(Meaning meaning, const std::vector<Number>& numbers, const std::string& dtype, std::vector<std::int64_t> shape) {
  const Array array = array_of(numbers, dtype, std::move(shape));
  return vertex_data(meaning, array, array, identity_of(cube()));
}

template <typename Number>
std::vector<Number> counted(std::size_t count, double factor = 1) {
  std::vector<Number> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<Number>(factor * static_cast<double>(i));
  return numbers;
}

TEST(VertexData, NamesAndLikelyMeanings) {
  for (const auto& [name, meaning] :
       {std::pair("color", Meaning::color), std::pair("texture", Meaning::texture), std::pair("label", Meaning::label),
        std::pair("value", Meaning::value), std::pair("weights", Meaning::weights)})
    EXPECT_EQ(meaning_named(name), meaning);
  EXPECT_EQ(meaning_named("colour"), std::nullopt);
  const auto likely = [](const std::string& dtype, std::size_t bytes, std::vector<std::int64_t> shape) {
    return likely_meaning(
        {.dtype = dtype, .kind = dtype[1], .item_bytes = bytes, .big_endian = false, .shape = std::move(shape), .bytes = {}});
  };
  EXPECT_EQ(likely("<i4", 4, {9}), Meaning::label);
  EXPECT_EQ(likely("|b1", 1, {9, 1}), Meaning::label);
  EXPECT_EQ(likely("|u1", 1, {9, 3}), Meaning::color);
  EXPECT_EQ(likely("|u1", 1, {9, 4}), Meaning::color);
  EXPECT_EQ(likely("<f4", 4, {9}), Meaning::value);
  EXPECT_EQ(likely("<f2", 2, {9, 2}), Meaning::texture);
  EXPECT_EQ(likely("<f8", 8, {9, 3}), Meaning::color);
  EXPECT_EQ(likely("<f8", 8, {9, 2, 2}), Meaning::weights);
  for (const auto& [dtype, bytes, columns] : {std::tuple("<i4", std::size_t{4}, 3), std::tuple("|u1", std::size_t{1}, 2),
                                              std::tuple("<c8", std::size_t{8}, 1), std::tuple("<f4", std::size_t{4}, 0)})
    expect_refusal(ErrorCode::invalid_parameter, [&] { (void)likely(dtype, bytes, {9, columns}); });
}

TEST(VertexData, WhatAnArrayCannotMeanIsRefused) {
  const auto refused = [](Meaning meaning, const std::string& dtype, std::vector<std::int64_t> shape) {
    const Array array{.dtype = dtype,
                      .kind = dtype[1],
                      .item_bytes = 4,
                      .big_endian = false,
                      .shape = std::move(shape),
                      .bytes = std::string(4096, '\0')};
    expect_refusal(ErrorCode::invalid_parameter, [&] { check_meaning(meaning, array); });
  };
  refused(Meaning::color, "<f4", {8, 2});
  refused(Meaning::color, "<u4", {8, 3});
  refused(Meaning::texture, "<i4", {8, 2});
  refused(Meaning::texture, "<f4", {8, 3});
  refused(Meaning::label, "<f4", {8});
  refused(Meaning::label, "<i4", {8, 2});
  refused(Meaning::value, "<f4", {8, 2});
  refused(Meaning::value, "<S4", {8});
  refused(Meaning::weights, "<i4", {8, 3});
  refused(Meaning::weights, "<f4", {8, most_weights + 1});
  expect_refusal(ErrorCode::invalid_parameter,
                 [] { (void)on_cube<std::int64_t>(Meaning::label, std::vector<std::int64_t>(8, std::int64_t{1} << 40), "<i8", {8}); });
  const Array array = array_of(counted<float>(8), "<f4", {8});
  EXPECT_THROW((void)vertex_data(Meaning::value, array, array, identity_of(polygons(icosphere(1)))), std::invalid_argument);
}

TEST(VertexData, ColorsStayAsTheyAre) {
  const VertexDataPair bytes = on_cube(Meaning::color, counted<std::uint8_t>(24, 10), "|u1", {8, 3});
  for (Eigen::Index v = 0; v < 8; ++v)
    for (Eigen::Index k = 0; k < 3; ++k) EXPECT_EQ(bytes.source.colors()(v, k), 10 * (3 * v + k));
  const VertexDataPair shares = on_cube(Meaning::color, counted<float>(32, 0.05), "<f4", {8, 4});
  EXPECT_NEAR(shares.target.paint(1, 2), 0.3, 1e-6);
  EXPECT_EQ(shares.target.paint(7, 2), 1) << "more than 1 is 1";
}

TEST(VertexData, EqualLabelsHaveOneColorAndNegativeOnesNone) {
  const VertexData data = on_cube<std::int16_t>(Meaning::label, {0, 1, 0, 2, -1, -7, 11, 12}, "<i2", {8}).source;
  EXPECT_EQ(data.paint.row(0), data.paint.row(2));
  EXPECT_EQ(data.paint.row(0), data.paint.row(7)) << "the colours repeat after twelve";
  EXPECT_GT((data.paint.row(0) - data.paint.row(1)).norm(), 0.2);
  for (const int v : {4, 5}) EXPECT_EQ(Eigen::RowVector3i(data.colors().row(v).cast<int>()), Eigen::RowVector3i::Constant(neutral_gray));
}

TEST(VertexData, BrightnessRisesWithTheValueAndTheTargetSetsTheScale) {
  const Array original = array_of<double>({0, 1, 2, 3, 4, 5, 6, nan}, "<f8", {8});
  const Array carried = array_of<double>({0, 1, 2, 3, 3, 3, 3, 3}, "<f8", {8});
  const VertexDataPair data = vertex_data(Meaning::value, carried, original, identity_of(cube()));
  double last = -1;
  for (Eigen::Index v = 0; v < 7; ++v) {
    const double brightness = data.target.paint.row(v) * Eigen::Vector3d(0.2126, 0.7152, 0.0722);
    EXPECT_GT(brightness, last);
    last = brightness;
  }
  EXPECT_TRUE(std::isnan(data.target.paint(7, 0)));
  EXPECT_EQ(data.source.paint.row(3), data.target.paint.row(3)) << "one value, one colour";
  const VertexData flat = on_cube<float>(Meaning::value, std::vector<float>(8, 3), "<f4", {8}).source;
  EXPECT_TRUE(flat.paint.allFinite());
}

TEST(VertexData, WeightsMixTheColorsOfTheirBones) {
  std::vector<float> weights(16, 0);
  weights[0] = 1;                   // the first bone
  weights[3] = 2;                   // the second, not normalised
  weights[4] = weights[5] = 0.25F;  // both alike
  const VertexData data = on_cube(Meaning::weights, weights, "<f4", {8, 2}).source;
  EXPECT_LT((data.paint.row(2) - (data.paint.row(0) + data.paint.row(1)) / 2).norm(), 1e-6);
  EXPECT_TRUE(std::isnan(data.paint(3, 0))) << "no bone, no colour";
}

TEST(VertexData, ADroppedVertexIsGray) {
  const PolygonMesh mesh = sphere_and_stray();
  const Correspondence map = identity_of(mesh);
  const Array labels = array_of(std::vector<std::int32_t>(166, 3), "<i4", {166});
  const VertexDataPair data = vertex_data(Meaning::label, transfer(labels, map, Interpolation::nearest), labels, map);
  EXPECT_FALSE(std::isnan(data.source.paint(0, 0)));
  EXPECT_TRUE(std::isnan(data.source.paint(165, 0)));
  EXPECT_FALSE(std::isnan(data.target.paint(165, 0)));
}

/// The header of a PLY file and where its rows begin.
std::string header_of(const std::string& ply) { return ply.substr(0, ply.find("end_header\n") + 11); }

template <typename Number>
Number number_at(const std::string& bytes, std::size_t place) {
  Number number{};
  std::memcpy(&number, bytes.substr(place, sizeof number).data(), sizeof number);
  return number;
}

TEST(VertexDataPly, HasThePropertiesOfItsMeaning) {
  const std::string label = encode_ply(cube(), on_cube(Meaning::label, counted<std::int32_t>(8), "<i4", {8}).source);
  EXPECT_NE(header_of(label).find("property uchar blue\nproperty int label\nelement face 6"), std::string::npos);
  EXPECT_EQ(number_at<std::int32_t>(label, header_of(label).size() + 5 * 19 + 15), 5);

  const std::string value = encode_ply(cube(), on_cube(Meaning::value, counted<double>(8, 0.5), "<f8", {8}).source);
  EXPECT_NE(header_of(value).find("property uchar blue\nproperty float quality\n"), std::string::npos);
  EXPECT_EQ(number_at<float>(value, header_of(value).size() + 5 * 19 + 15), 2.5F);

  const std::string weights = encode_ply(cube(), on_cube(Meaning::weights, counted<float>(16), "<f4", {8, 2}).source);
  EXPECT_NE(header_of(weights).find("property float weight_0\nproperty float weight_1\n"), std::string::npos);
  EXPECT_EQ(number_at<float>(weights, header_of(weights).size() + 3 * 23 + 19), 7);

  const std::string color = encode_ply(cube(), on_cube(Meaning::color, counted<std::uint8_t>(24), "|u1", {8, 3}).source);
  EXPECT_NE(header_of(color).find("property uchar blue\nelement face"), std::string::npos);
  EXPECT_EQ(number_at<std::uint8_t>(color, header_of(color).size() + 2 * 15 + 13), 7);
}

TEST(VertexDataPly, TextureCoordinatesStandUnderBothNamesThatProgramsRead) {
  const std::string file = encode_ply(cube(), on_cube(Meaning::texture, counted<float>(16, 0.0625), "<f4", {8, 2}).source);
  const std::string header = header_of(file);
  EXPECT_NE(
      header.find("property float z\nproperty float s\nproperty float t\nproperty float texture_u\nproperty float texture_v\nelement"),
      std::string::npos);
  EXPECT_EQ(header.find("red"), std::string::npos);
  for (const std::size_t v : {0U, 7U}) {
    for (const std::size_t k : {0U, 1U}) {
      const float expected = 0.0625F * static_cast<float>(2 * v + k);
      EXPECT_EQ(number_at<float>(file, header.size() + 28 * v + 12 + 4 * k), expected);
      EXPECT_EQ(number_at<float>(file, header.size() + 28 * v + 20 + 4 * k), expected);
    }
  }
}

TEST(VertexDataPly, ReadsBackAsTheUpload) {
  PolygonMesh far = cube();
  far.vertices.array() += 1e7 / 3;
  for (const PolygonMesh& mesh : {cube(), far}) {
    const std::string file = encode_ply(mesh, on_cube(Meaning::label, counted<std::int32_t>(8), "<i4", {8}).source);
    const PolygonMesh read = read_mesh(std::as_bytes(std::span(file)), "");
    EXPECT_EQ(read.vertices, mesh.vertices);
    EXPECT_EQ(read.indices, mesh.indices);
  }
}

TEST(VertexDataGlb, HasColorsOrTextureCoordinatesWithAPicture) {
  const VertexData label = on_cube(Meaning::label, counted<std::int32_t>(8), "<i4", {8}).source;
  const Glb colored(encode_glb(cube(), label));
  EXPECT_EQ(colored.accessor("COLOR_0")["normalized"], true);
  const std::vector<std::uint16_t> light = colored.numbers<std::uint16_t>("COLOR_0", "VEC4", 5123, 4);
  for (Eigen::Index v = 0; v < 8; ++v) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      // sRGB is close to a power of 2.2, and the same at both ends.
      const double shown = std::pow(light[static_cast<std::size_t>(4 * v + k)] / 65535.0, 1 / 2.2);
      EXPECT_NEAR(shown, label.colors()(v, k) / 255.0, 0.04);
    }
    EXPECT_EQ(light[static_cast<std::size_t>(4 * v + 3)], 65535);
  }
  EXPECT_FALSE(colored.json.contains("images"));

  const Glb glb(encode_glb(cube(), on_cube(Meaning::texture, counted<float>(16, 0.0625), "<f4", {8, 2}).source));
  EXPECT_FALSE(glb.primitive()["attributes"].contains("COLOR_0"));
  const std::vector<float> coordinates = glb.numbers<float>("TEXCOORD_0", "VEC2", 5126, 2);
  EXPECT_EQ(coordinates[6], 0.375F);
  EXPECT_EQ(coordinates[7], 1 - 0.4375F) << "v downward";
  const auto& material = glb.json["materials"][glb.primitive()["material"].get<std::size_t>()];
  const auto& texture = glb.json["textures"][material["pbrMetallicRoughness"]["baseColorTexture"]["index"].get<std::size_t>()];
  const auto& picture = glb.json["images"][texture["source"].get<std::size_t>()];
  EXPECT_EQ(picture["mimeType"], "image/png");
  const auto& view = glb.json["bufferViews"][picture["bufferView"].get<std::size_t>()];
  EXPECT_FALSE(view.contains("target"));
  Image image = decoded_png(glb.bytes.substr(view["byteOffset"], view["byteLength"]));
  const Eigen::Vector3f low = checker_color(0.5F / 256, 0.5F / 256);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(image.at(0, 255)[k], 255 * low(k), 1) << "v upward in the picture";
}

TEST(VertexDataGlb, WhatHasNoTextureCoordinatesHasZero) {
  std::vector<float> numbers = counted<float>(16);
  numbers[4] = static_cast<float>(nan);
  const Glb glb(encode_glb(cube(), on_cube(Meaning::texture, numbers, "<f4", {8, 2}).source));
  const std::vector<float> coordinates = glb.numbers<float>("TEXCOORD_0", "VEC2", 5126, 2);
  EXPECT_EQ(coordinates[4], 0);
  EXPECT_EQ(coordinates[5], 0);
}

TEST(VertexDataFiles, AMeshOfAnotherSizeIsRefused) {
  const VertexData data = on_cube(Meaning::label, counted<std::int32_t>(8), "<i4", {8}).source;
  EXPECT_THROW((void)encode_ply(polygons(icosphere(1)), data), std::invalid_argument);
  EXPECT_THROW((void)encode_glb(polygons(icosphere(1)), data), std::invalid_argument);
}

TEST(VertexDataPicture, ShowsTheSourceInWhatWasCarriedAndTheTargetInTheOriginal) {
  const PolygonMesh mesh = polygons(creature(3));
  const Surface surface = repair(mesh, RepairMode::none);
  const auto n = static_cast<std::size_t>(mesh.vertex_count());
  const Array red = array_of(std::vector<std::int32_t>(n, 6), "<i4", {mesh.vertex_count()});
  const Array blue = array_of(std::vector<std::int32_t>(n, 0), "<i4", {mesh.vertex_count()});
  Image image =
      decoded_png(encode_png(vertex_data(Meaning::label, red, blue, identity_map(surface)), identity_map(surface), surface, surface));
  double difference = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.height; ++x) {
      EXPECT_GE(image.at(x, y)[0], image.at(x, y)[2]);                                // red, or white
      EXPECT_LE(image.at(x + image.height, y)[0], image.at(x + image.height, y)[2]);  // blue, or white
      difference += image.at(x, y)[0] - image.at(x + image.height, y)[0];
    }
  }
  EXPECT_GT(difference, 1e6);
}

}  // namespace
}  // namespace spherematch::test
