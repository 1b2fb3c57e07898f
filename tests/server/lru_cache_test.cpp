#include "server/lru_cache.h"

#include <gtest/gtest.h>

#include "server/memory_size.h"

namespace spherematch {
namespace {

/// Values that claim a size of their own.
using Cache = LruCache<std::size_t>;
void put(Cache& cache, const std::string& key, std::size_t bytes) { cache.put(key, std::make_shared<const std::size_t>(bytes), bytes); }

TEST(LruCache, DropsTheLeastRecentlyUsed) {
  Cache cache(3);
  for (const char* key : {"a", "b", "c"}) put(cache, key, 1);
  EXPECT_NE(cache.find("a"), nullptr);  // now b is the oldest
  put(cache, "d", 1);
  EXPECT_NE(cache.find("a"), nullptr);
  EXPECT_EQ(cache.find("b"), nullptr);
  EXPECT_NE(cache.find("c"), nullptr);
  EXPECT_NE(cache.find("d"), nullptr);
  EXPECT_EQ(cache.bytes(), 3U);
}

TEST(LruCache, ALargeOnePushesOutSeveralAndATooLargeOneNone) {
  Cache cache(3);
  for (const char* key : {"a", "b", "c"}) put(cache, key, 1);
  put(cache, "large", 4);
  EXPECT_EQ(cache.find("large"), nullptr);
  EXPECT_NE(cache.find("a"), nullptr);
  put(cache, "d", 2);
  EXPECT_EQ(cache.find("b"), nullptr);
  EXPECT_EQ(cache.find("c"), nullptr);
  EXPECT_NE(cache.find("a"), nullptr);
  EXPECT_EQ(cache.bytes(), 3U);
}

TEST(LruCache, ReplacingAndErasingKeepTheCount) {
  Cache cache(3);
  put(cache, "a", 2);
  const Cache::Pointer held = cache.find("a");
  put(cache, "a", 1);
  EXPECT_EQ(cache.bytes(), 1U);
  EXPECT_EQ(*held, 2U);
  cache.erase("a");
  cache.erase("a");
  EXPECT_EQ(cache.bytes(), 0U);
  EXPECT_EQ(cache.find("a"), nullptr);
  // One that does not fit must not leave an older one of the same key behind.
  put(cache, "a", 1);
  put(cache, "a", 4);
  EXPECT_EQ(cache.find("a"), nullptr);
  EXPECT_EQ(cache.bytes(), 0U);
}

TEST(LruCache, ErasesByKey) {
  Cache cache(3);
  for (const char* key : {"ax", "bx", "ay"}) put(cache, key, 1);
  cache.erase_if([](std::string_view key) { return key.starts_with("a"); });
  EXPECT_EQ(cache.find("ax"), nullptr);
  EXPECT_EQ(cache.find("ay"), nullptr);
  EXPECT_NE(cache.find("bx"), nullptr);
  EXPECT_EQ(cache.bytes(), 1U);
}

TEST(MemorySize, CountsTheArraysOfAShape) {
  PreprocessedShape shape;
  const std::size_t empty = memory_size(shape);
  shape.eigenvectors = Eigen::MatrixXf::Zero(1000, 20);
  EXPECT_EQ(memory_size(shape), empty + 80'000);
  shape.signals.push_back({"s", Eigen::MatrixXf::Zero(64, 64)});
  EXPECT_EQ(memory_size(shape), empty + 80'000 + 16'384);
  shape.surface.surface_vertex.resize(100);
  shape.surface.mesh.vertices.resize(100, 3);
  EXPECT_EQ(memory_size(shape), empty + 80'000 + 16'384 + 400 + 2400);
}

TEST(MemorySize, CountsTheArraysOfAMap) {
  MatchResult result;
  const std::size_t empty = memory_size(result);
  result.map.vertex.resize(10);
  result.map.corners.setZero(10, 3);
  result.map.bary.setZero(10, 3);
  EXPECT_EQ(memory_size(result), empty + 280);
}

}  // namespace
}  // namespace spherematch
