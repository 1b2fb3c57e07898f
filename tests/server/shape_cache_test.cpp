#include "server/shape_cache.h"

#include <gtest/gtest.h>

namespace spherematch {
namespace {

ShapePointer shape_of_size(Eigen::Index vertices) {
  auto shape = std::make_shared<PreprocessedShape>();
  shape->sphere = Points::Zero(vertices, 3);
  return shape;
}

const std::size_t unit = memory_of(*shape_of_size(1000));

TEST(ShapeCache, MemoryCountsTheArrays) {
  PreprocessedShape shape;
  const std::size_t empty = memory_of(shape);
  shape.eigenvectors = Eigen::MatrixXf::Zero(1000, 20);
  EXPECT_EQ(memory_of(shape), empty + 80'000);
  shape.signals.push_back({"s", Eigen::MatrixXf::Zero(64, 64)});
  EXPECT_EQ(memory_of(shape), empty + 80'000 + 16'384);
  shape.surface.surface_vertex.resize(100);
  shape.surface.mesh.vertices.resize(100, 3);
  EXPECT_EQ(memory_of(shape), empty + 80'000 + 16'384 + 400 + 2400);
}

TEST(ShapeCache, DropsTheLeastRecentlyUsed) {
  ShapeCache cache(3 * unit);
  for (const char* id : {"a", "b", "c"}) cache.put(id, shape_of_size(1000));
  EXPECT_NE(cache.find("a"), nullptr);  // now b is the oldest
  cache.put("d", shape_of_size(1000));
  EXPECT_NE(cache.find("a"), nullptr);
  EXPECT_EQ(cache.find("b"), nullptr);
  EXPECT_NE(cache.find("c"), nullptr);
  EXPECT_NE(cache.find("d"), nullptr);
  EXPECT_EQ(cache.bytes(), 3 * unit);
}

TEST(ShapeCache, ALargeOnePushesOutSeveralAndATooLargeOneNone) {
  ShapeCache cache(3 * unit);
  for (const char* id : {"a", "b", "c"}) cache.put(id, shape_of_size(1000));
  cache.put("large", shape_of_size(100'000));
  EXPECT_EQ(cache.find("large"), nullptr);
  EXPECT_NE(cache.find("a"), nullptr);
  cache.put("d", shape_of_size(2000));
  EXPECT_EQ(cache.find("b"), nullptr);
  EXPECT_EQ(cache.find("c"), nullptr);
  EXPECT_NE(cache.find("a"), nullptr);
  EXPECT_LE(cache.bytes(), 3 * unit);
}

TEST(ShapeCache, ReplacingAndErasingKeepTheCount) {
  ShapeCache cache(3 * unit);
  cache.put("a", shape_of_size(2000));
  const ShapePointer held = cache.find("a");
  cache.put("a", shape_of_size(1000));
  EXPECT_EQ(cache.bytes(), unit);
  EXPECT_EQ(held->sphere.rows(), 2000);
  cache.erase("a");
  cache.erase("a");
  EXPECT_EQ(cache.bytes(), 0U);
  EXPECT_EQ(cache.find("a"), nullptr);
  // One that does not fit must not leave an older one of the same id behind.
  cache.put("a", shape_of_size(1000));
  cache.put("a", shape_of_size(100'000));
  EXPECT_EQ(cache.find("a"), nullptr);
  EXPECT_EQ(cache.bytes(), 0U);
}

}  // namespace
}  // namespace spherematch
