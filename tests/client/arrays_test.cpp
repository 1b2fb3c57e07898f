#include "client/arrays.h"

#include <gtest/gtest.h>

#include "client/errors.h"
#include "engine/io/map_writer.h"

namespace spherematch::client {
namespace {

Correspondence sample_map(std::int32_t rows, std::int32_t first) {
  Correspondence map;
  map.corners.resize(rows, 3);
  map.bary.resize(rows, 3);
  for (std::int32_t i = 0; i < rows; ++i) {
    map.vertex.push_back(first + i);
    map.corners.row(i) << first + i, 7, -1;
    map.bary.row(i) << 0.5F, 0.25F, 0.25F;
  }
  return map;
}

TEST(ClientArrays, ReadsWhatTheServerWrites) {
  const Map map = decode_map(encode_npz(sample_map(100, 3)));
  ASSERT_EQ(map.vertex.size(), 100U);
  EXPECT_EQ(map.vertex[99], 102);
  EXPECT_EQ(map.corners[1], (std::array<std::int32_t, 3>{4, 7, -1}));
  EXPECT_EQ(map.bary[2], (std::array<float, 3>{0.5F, 0.25F, 0.25F}));
  EXPECT_EQ(map.reverse, nullptr);

  const Map both = decode_map(encode_npz(sample_map(4, 0), sample_map(6, 9)));
  EXPECT_EQ(both.vertex.size(), 4U);
  ASSERT_NE(both.reverse, nullptr);
  EXPECT_EQ(both.reverse->vertex, (std::vector<std::int32_t>{9, 10, 11, 12, 13, 14}));
  EXPECT_TRUE(decode_map(encode_npz(sample_map(0, 0))).vertex.empty());
}

TEST(ClientArrays, QualityIsThereWhereItWasAskedFor) {
  const VertexQuality quality{.distortion = {0, 0.5F}, .confidence = {1, 0.25F}}, reverse{.distortion = {}, .confidence = {0, 0, 1}};
  const Map map = decode_map(encode_npz(sample_map(2, 0), sample_map(3, 0), quality, reverse));
  EXPECT_EQ(map.confidence, quality.confidence);
  EXPECT_EQ(map.distortion, quality.distortion);
  EXPECT_EQ(map.reverse->confidence, reverse.confidence);
  EXPECT_TRUE(map.reverse->distortion.empty());
  EXPECT_TRUE(decode_map(encode_npz(sample_map(2, 0))).confidence.empty());
  EXPECT_THROW((void)decode_map(encode_npz(sample_map(3, 0), quality)), FormatError);  // two numbers for three vertices
}

TEST(ClientArrays, WhatIsDamagedIsRefused) {
  const std::string good =
      encode_npz(sample_map(20, 0), VertexQuality{.distortion = std::vector<float>(20), .confidence = std::vector<float>(20)});
  for (std::size_t size = 0; size < good.size(); ++size) EXPECT_THROW((void)decode_map(good.substr(0, size)), FormatError) << size;
  // Any byte may be wrong: an error or other numbers, but nothing worse.
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x55);
    try {
      (void)decode_map(bad);
    } catch (const FormatError&) {
    }
  }
}

TEST(ClientArrays, NumbersAsNpy) {
  const std::vector<double> values{1, -0.5, 1e300, 4, 5, 6};
  for (const std::size_t columns : {1U, 2U, 3U, 6U}) {
    const std::string npy = encode_npy(values, columns);
    EXPECT_EQ((npy.size() - 48) % 64, 0U);  // the header ends at a multiple of 64
    EXPECT_EQ(decode_npy(npy), values);
  }
  EXPECT_NE(encode_npy(values, 2).find("(3, 2)"), std::string::npos);
  EXPECT_NE(encode_npy(values, 1).find("(6,)"), std::string::npos);
  EXPECT_TRUE(decode_npy(encode_npy({}, 1)).empty());
  EXPECT_THROW((void)encode_npy(values, 4), std::invalid_argument);
  EXPECT_THROW((void)encode_npy(values, 0), std::invalid_argument);
  EXPECT_THROW((void)decode_npy("\x93NUMPY"), FormatError);
  EXPECT_THROW((void)decode_npy(spherematch::encode_npy(sample_map(3, 0))), FormatError);  // int32
}

}  // namespace
}  // namespace spherematch::client
