#include "storage/match_store.h"

#include <SQLiteCpp/Database.h>
#include <gtest/gtest.h>

#include "storage/match_codec.h"
#include "tests/storage/sample_shapes.h"
#include "tests/storage/store_file.h"

namespace spherematch {
namespace {

using testing::error_of;
using testing::random_matrix;
using testing::random_triangles;
using testing::same_bits;

Correspondence sample_map(std::int32_t rows, unsigned seed) {
  std::mt19937 random(seed);
  Correspondence map;
  map.corners = random_triangles(random, rows, -1, 99);
  map.bary = random_matrix<decltype(map.bary)>(random, rows, 3);
  for (std::int32_t i = 0; i < rows; ++i) map.vertex.push_back(map.corners(i, 0));
  return map;
}

MatchResult sample_result(std::int32_t rows = 40, unsigned seed = 1) {
  MatchResult result;
  result.map = sample_map(rows, seed);
  result.candidates = {{{1, 0, 0, 0, -1, 0, 0, 0, 1}, 0.9, 0.125, false}, {{0, 1, 0, 1, 0, 0, 0, 0, -1}, 0.8, 0.0625, true}};
  result.quality = {{"score", 0.5}, {"nothing", std::numeric_limits<double>::quiet_NaN()}};
  result.seconds = {{"rotation", 0.25}, {"total", 1}};
  return result;
}

void expect_same(const Correspondence& a, const Correspondence& b) {
  EXPECT_EQ(a.vertex, b.vertex);
  EXPECT_TRUE(same_bits(a.corners, b.corners));
  EXPECT_TRUE(same_bits(a.bary, b.bary));
}

TEST(MatchCodec, KeepsEveryBit) {
  MatchResult result = sample_result();
  result.reverse = sample_map(7, 2);
  result.reversed = true;
  const MatchResult again = decode_match(encode_match(result));
  expect_same(again.map, result.map);
  expect_same(again.reverse, result.reverse);
  EXPECT_TRUE(again.reversed);
  ASSERT_EQ(again.candidates.size(), 2U);
  EXPECT_EQ(again.candidates[1].rotation, result.candidates[1].rotation);
  EXPECT_EQ(again.candidates[1].correlation, 0.8);
  EXPECT_EQ(again.candidates[1].score, 0.0625);
  EXPECT_TRUE(again.candidates[1].chosen && !again.candidates[0].chosen);
  EXPECT_EQ(again.quality[0], result.quality[0]);
  EXPECT_TRUE(std::isnan(again.quality[1].second));
  EXPECT_EQ(again.seconds, result.seconds);
  EXPECT_TRUE(decode_match(encode_match({})).map.vertex.empty());
}

TEST(MatchCodec, RefusesDamage) {
  const std::vector<std::byte> good = encode_match(sample_result());
  for (std::size_t size = 0; size < good.size(); size += 7) {
    EXPECT_EQ(error_of([&] { (void)decode_match(std::span(good).first(size)); }), StorageErrorCode::corrupt_blob) << size;
  }
  for (std::size_t at = 24; at < good.size(); at += 13) {
    std::vector<std::byte> bad = good;
    bad[at] ^= std::byte{1};
    EXPECT_EQ(error_of([&] { (void)decode_match(bad); }), StorageErrorCode::corrupt_blob) << at;
  }
}

class MatchStoreTest : public ::testing::Test {
 protected:
  MatchStoreTest() {
    for (const char* name : {"a", "b", "c"}) {
      const std::string bytes = name;
      ids.push_back(content_id(std::as_bytes(std::span(bytes)), "repair=fill").id);
      shapes.insert(content_id(std::as_bytes(std::span(bytes)), "repair=fill"), {}, std::as_bytes(std::span(bytes)), surface);
    }
  }
  testing::StoreFile file;
  ShapeStore shapes{file.path()};
  Surface surface = testing::sample_surface();
  std::vector<std::string> ids;
};

TEST_F(MatchStoreTest, KeepsResultsAcrossARestart) {
  {
    MatchStore store(shapes, 1 << 20);
    EXPECT_EQ(store.find("k"), nullptr);
    EXPECT_TRUE(store.save("k", ids[0], ids[1], "1", sample_result()));
    EXPECT_TRUE(store.save("self", ids[0], ids[0], "1", sample_result()));
  }
  const ShapeStore reopened(file.path());
  MatchStore store(reopened, 1 << 20);
  const auto found = store.find("k");
  ASSERT_NE(found, nullptr);
  expect_same(found->map, sample_result().map);
  EXPECT_NE(store.find("self"), nullptr);
}

TEST_F(MatchStoreTest, GoesWithItsShapes) {
  MatchStore store(shapes, 1 << 20);
  store.save("ab", ids[0], ids[1], "1", sample_result());
  store.save("ba", ids[1], ids[0], "1", sample_result());
  store.save("bc", ids[1], ids[2], "1", sample_result());
  shapes.remove(ids[0]);
  EXPECT_EQ(store.find("ab"), nullptr);
  EXPECT_EQ(store.find("ba"), nullptr);
  EXPECT_NE(store.find("bc"), nullptr);
  EXPECT_FALSE(store.save("ab", ids[0], ids[1], "1", sample_result()));
  EXPECT_EQ(store.find("ab"), nullptr);
}

TEST_F(MatchStoreTest, AnotherEnginesResultsGoWithTheFirstNewOne) {
  MatchStore store(shapes, 1 << 20);
  store.save("old", ids[0], ids[1], "1", sample_result());
  store.save("old elsewhere", ids[2], ids[2], "1", sample_result());
  store.save("new", ids[1], ids[1], "2", sample_result());
  EXPECT_EQ(store.find("old"), nullptr);
  EXPECT_NE(store.find("old elsewhere"), nullptr);
  EXPECT_NE(store.find("new"), nullptr);
}

TEST_F(MatchStoreTest, TheBoundHoldsAndTheOldestGoFirst) {
  const std::size_t one = encode_match(sample_result()).size();
  MatchStore store(shapes, 3 * one);
  for (const char* key : {"1", "2", "3", "4"}) EXPECT_TRUE(store.save(key, ids[0], ids[1], "1", sample_result()));
  EXPECT_EQ(store.bytes(), 3 * one);
  EXPECT_EQ(store.find("1"), nullptr);
  EXPECT_NE(store.find("2"), nullptr);

  // A use long after the last one is remembered.
  SQLite::Database(file.path().string(), SQLite::OPEN_READWRITE).exec("UPDATE matches SET used_at = used_at - 10000");
  EXPECT_NE(store.find("2"), nullptr);
  store.save("5", ids[0], ids[1], "1", sample_result());
  EXPECT_NE(store.find("2"), nullptr);
  EXPECT_EQ(store.find("3"), nullptr);

  EXPECT_TRUE(store.save("2", ids[0], ids[1], "1", sample_result()));  // replaces
  EXPECT_EQ(store.bytes(), 3 * one);
  EXPECT_FALSE(store.save("large", ids[0], ids[1], "1", sample_result(4000)));
  EXPECT_NE(store.find("5"), nullptr);
  MatchStore none(shapes, 0);
  EXPECT_FALSE(none.save("6", ids[0], ids[1], "1", sample_result()));
  EXPECT_EQ(none.find("5"), nullptr);
}

TEST_F(MatchStoreTest, WhatCannotBeReadIsForgotten) {
  MatchStore store(shapes, 1 << 20);
  store.save("k", ids[0], ids[1], "1", sample_result());
  SQLite::Database(file.path().string(), SQLite::OPEN_READWRITE).exec("UPDATE matches SET data = substr(data, 1, 50)");
  EXPECT_EQ(store.find("k"), nullptr);
  EXPECT_EQ(store.bytes(), 0U);
}

}  // namespace
}  // namespace spherematch
