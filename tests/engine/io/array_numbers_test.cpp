#include "engine/io/array_numbers.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "engine/data/error.h"
#include "tests/engine/io/arrays.h"
#include "tests/support/surface_checks.h"

namespace spherematch::test {
namespace {

template <typename Number>
void expect_numbers(const std::string& dtype) {
  const std::vector<Number> numbers{0, 1, 2, std::numeric_limits<Number>::max(), std::numeric_limits<Number>::lowest(), 7};
  const Eigen::MatrixXd read = numbers_of(array_of(numbers, dtype, {3, 2}));
  ASSERT_EQ(read.rows(), 3);
  ASSERT_EQ(read.cols(), 2);
  for (Eigen::Index i = 0; i < 6; ++i) EXPECT_EQ(read(i / 2, i % 2), static_cast<double>(numbers[static_cast<std::size_t>(i)])) << dtype;
}

TEST(ArrayNumbers, EveryDtypeInEitherByteOrder) {
  expect_numbers<std::uint8_t>("|u1");
  expect_numbers<std::int8_t>("|i1");
  expect_numbers<std::uint16_t>("<u2");
  expect_numbers<std::int16_t>(">i2");
  expect_numbers<std::uint32_t>(">u4");
  expect_numbers<std::int32_t>("<i4");
  expect_numbers<std::uint64_t>("<u8");
  expect_numbers<std::int64_t>(">i8");
  expect_numbers<float>(">f4");
  expect_numbers<float>("<f4");
  expect_numbers<double>("<f8");
  expect_numbers<double>(">f8");
  const Array half = array_of<std::uint16_t>({0x3C00, 0xC000}, "<f2", {2});
  EXPECT_EQ(numbers_of(half), Eigen::Vector2d(1, -2));
  EXPECT_EQ(numbers_of(array_of<std::uint8_t>({1, 0}, "|b1", {2})), Eigen::Vector2d(1, 0));
}

TEST(ArrayNumbers, FurtherDimensionsAreColumns) {
  const Eigen::MatrixXd read = numbers_of(array_of<float>({1, 2, 3, 4, 5, 6, 7, 8}, "<f4", {2, 2, 2}));
  EXPECT_EQ(read, (Eigen::MatrixXd(2, 4) << 1, 2, 3, 4, 5, 6, 7, 8).finished());
  EXPECT_EQ(numbers_of(array_of<float>({}, "<f4", {0, 3})).rows(), 0);
}

TEST(ArrayNumbers, WhatIsNoNumberIsRefused) {
  for (const char* dtype : {"<c8", "|S8", "|V8", "<M8"}) {
    const Array array = array_of<double>({1}, dtype, {1});
    expect_refusal(ErrorCode::invalid_parameter, [&] { (void)numbers_of(array); });
  }
}

}  // namespace
}  // namespace spherematch::test
