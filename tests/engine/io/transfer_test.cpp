#include "engine/io/transfer.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "engine/data/error.h"
#include "engine/io/map_mesh.h"
#include "tests/engine/io/arrays.h"
#include "tests/engine/io/some_maps.h"

namespace spherematch::test {
namespace {

template <typename Number>
std::vector<Number> numbers_of(const Array& array) {
  std::vector<Number> numbers(array.bytes.size() / sizeof(Number));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::array<char, sizeof(Number)> raw{};
    std::memcpy(raw.data(), array.bytes.data() + i * sizeof(Number), sizeof(Number));
    if (array.big_endian) std::reverse(raw.begin(), raw.end());
    numbers[i] = std::bit_cast<Number>(raw);
  }
  return numbers;
}

Array positions_of(const Points& points, const std::string& dtype = "<f8") {
  return array_of(std::vector<double>(points.data(), points.data() + points.size()), dtype, {points.rows(), 3});
}

/// A target of four vertices; the second of the three source vertices was dropped.
Correspondence small_map() {
  Correspondence map;
  map.vertex = {2, -1, 0};
  map.corners.resize(3, 3);
  map.corners << 2, 1, 3, -1, -1, -1, 3, 0, 1;
  map.bary.resize(3, 3);
  map.bary << 0.5F, 0.25F, 0.25F, 0, 0, 0, 0.0F, 1.0F, 0.0F;
  return map;
}

TEST(Transfer, TheIdentityMovesNothing) {
  const PolygonMesh sphere = polygons(icosphere(2));
  const Correspondence map = identity_map(repair(sphere, RepairMode::none));
  const Array positions = positions_of(sphere.vertices);
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::nearest}) {
    const Array moved = transfer(positions, map, interpolation);
    EXPECT_EQ(moved.bytes, positions.bytes);
    EXPECT_EQ(moved.shape, positions.shape);
    EXPECT_EQ(moved.dtype, positions.dtype);
  }
}

TEST(Transfer, LinearOnPositionsGivesTheImages) {
  const PolygonMesh upload = sphere_and_stray();
  const Surface surface = repair(upload, RepairMode::fill);
  Correspondence map = identity_map(surface);
  for (Eigen::Index i = 0; i < 162; ++i) {
    const auto share = static_cast<float>(i) / 400;
    map.bary.row(i) << share, 0.5F * share, 1 - 1.5F * share;
  }
  const Points images = image_points(map, surface);
  for (const char* dtype : {"<f8", ">f8"}) {
    const Array moved = transfer(positions_of(upload.vertices, dtype), map, Interpolation::linear);
    EXPECT_EQ(moved.dtype, dtype);
    const std::vector<double> numbers = numbers_of<double>(moved);
    ASSERT_EQ(static_cast<Eigen::Index>(numbers.size()), images.size());
    for (Eigen::Index i = 0; i < images.size(); ++i) {
      const double number = numbers[static_cast<std::size_t>(i)];
      if (i < 3 * 162) {
        EXPECT_NEAR(number, images.data()[i], 1e-15);
      } else {
        EXPECT_TRUE(std::isnan(number));
      }
    }
  }
}

TEST(Transfer, NearestMovesLabels) {
  const Array moved = transfer(array_of<std::uint8_t>({7, 8, 9, 10}, "|u1", {4}), small_map(), Interpolation::nearest);
  EXPECT_EQ(numbers_of<std::uint8_t>(moved), (std::vector<std::uint8_t>{9, 0, 7}));
  EXPECT_EQ(moved.shape, std::vector<std::int64_t>{3});
  EXPECT_EQ(moved.dtype, "|u1");
}

TEST(Transfer, NearestMovesRowsOfAnyDtypeByteForByte) {
  for (const auto& [dtype, size] : std::vector<std::pair<std::string, std::size_t>>{
           {"|b1", 1}, {">i2", 2}, {"<i8", 8}, {"<c16", 16}, {"|S5", 5}, {"<U2", 8}, {"|V3", 3}, {"<M8[s]", 8}}) {
    Array values{.dtype = dtype, .kind = dtype[1], .item_bytes = size, .big_endian = dtype[0] == '>', .shape = {4, 2, 3}, .bytes = {}};
    for (std::size_t i = 0; i < 24 * size; ++i) values.bytes += static_cast<char>(i % 251 + 1);
    const Array moved = transfer(values, small_map(), Interpolation::nearest);
    EXPECT_EQ(moved.shape, (std::vector<std::int64_t>{3, 2, 3}));
    const std::size_t row = 6 * size;
    EXPECT_EQ(moved.bytes, values.bytes.substr(2 * row, row) + std::string(row, '\0') + values.bytes.substr(0, row)) << dtype;
  }
}

TEST(Transfer, LinearKeepsDtypeByteOrderAndTrailingShape) {
  const std::vector<float> values{0, 1, 10, 11, 20, 21, 30, 31};
  for (const char* dtype : {"<f4", ">f4"}) {
    const Array moved = transfer(array_of(values, dtype, {4, 1, 2}), small_map(), Interpolation::linear);
    EXPECT_EQ(moved.shape, (std::vector<std::int64_t>{3, 1, 2}));
    EXPECT_EQ(moved.dtype, dtype);
    const std::vector<float> numbers = numbers_of<float>(moved);
    EXPECT_EQ(numbers[0], 20.0F);  // 0.5 * 20 + 0.25 * 10 + 0.25 * 30
    EXPECT_EQ(numbers[1], 21.0F);
    EXPECT_TRUE(std::isnan(numbers[2]) && std::isnan(numbers[3]));
    EXPECT_EQ(numbers[4], 0.0F);
    EXPECT_EQ(numbers[5], 1.0F);
  }
}

TEST(Transfer, HalfPrecisionIsInterpolated) {
  // 1, 2, 4 and -0.5 in half precision.
  for (const char* dtype : {"<f2", ">f2"}) {
    const Array moved = transfer(array_of<std::uint16_t>({0x3C00, 0x4000, 0x4400, 0xB800}, dtype, {4}), small_map(), Interpolation::linear);
    const std::vector<std::uint16_t> numbers = numbers_of<std::uint16_t>(moved);
    EXPECT_EQ(numbers[0], 0x40C0);  // 0.5 * 4 + 0.25 * 2 - 0.25 * 0.5 = 2.375 = 2 (1 + 192 / 1024)
    EXPECT_GT(numbers[1] & 0x7FFF, 0x7C00);
    EXPECT_EQ(numbers[2], 0x3C00);
  }
}

TEST(Transfer, ACornerOfWeightZeroHasNoPart) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Array moved = transfer(array_of<double>({5, infinity, 2, std::nan("")}, "<f8", {4}), small_map(), Interpolation::linear);
  EXPECT_EQ(numbers_of<double>(moved)[2], 5);
  EXPECT_TRUE(std::isnan(numbers_of<double>(moved)[0]));
}

TEST(Transfer, ADroppedVertexHasNotANumberAlsoByNearest) {
  const std::vector<double> numbers =
      numbers_of<double>(transfer(array_of<double>({1, 2, 3, 4}, ">f8", {4}), small_map(), Interpolation::nearest));
  EXPECT_EQ(numbers[0], 3);
  EXPECT_TRUE(std::isnan(numbers[1]));
  EXPECT_EQ(numbers[2], 1);
}

TEST(Transfer, RowsMayBeEmpty) {
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::nearest}) {
    const Array moved = transfer(array_of<float>({}, "<f4", {4, 0, 5}), small_map(), interpolation);
    EXPECT_EQ(moved.shape, (std::vector<std::int64_t>{3, 0, 5}));
    EXPECT_EQ(moved.bytes, "");
  }
}

TEST(Transfer, LinearNeedsFloatingPointNumbers) {
  for (const char* dtype : {"<i4", "<u4", "|b1", "<c8", "|S4"}) {
    Array values = array_of<std::uint32_t>({1, 2, 3, 4}, dtype, {4});
    try {
      (void)transfer(values, small_map(), Interpolation::linear);
      ADD_FAILURE() << dtype;
    } catch (const EngineError& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_parameter);
      EXPECT_NE(std::string(error.what()).find("nearest works"), std::string::npos);
    }
  }
}

TEST(Transfer, AMapBeyondTheRowsIsRefused) {
  const Array values = array_of<double>({1, 2}, "<f8", {2});
  EXPECT_THROW((void)transfer(values, small_map(), Interpolation::nearest), std::invalid_argument);
  EXPECT_THROW((void)transfer(values, small_map(), Interpolation::linear), std::invalid_argument);
}

}  // namespace
}  // namespace spherematch::test
