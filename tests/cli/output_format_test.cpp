#include "cli/output_format.h"

#include <gtest/gtest.h>

namespace spherematch {
namespace {

TEST(OutputFormat, FollowsTheExtension) {
  EXPECT_EQ(output_format_of("map.npz"), OutputFormat::npz);
  EXPECT_EQ(output_format_of("a.b/MAP.NPY"), OutputFormat::npy);
  EXPECT_EQ(output_format_of("map.txt"), OutputFormat::text);
  for (const char* file : {"map", "map.ply", "npz", ".npz", "map.npz/", "map.npz.gz", ""})
    EXPECT_EQ(output_format_of(file), std::nullopt) << file;
  EXPECT_EQ(supported_extensions(), ".npz, .npy, .txt");
}

TEST(OutputFormat, EncodesAsAsked) {
  Correspondence map;
  map.vertex = {3, -1};
  map.corners.setZero(2, 3);
  map.bary.setZero(2, 3);
  EXPECT_EQ(encode(map, OutputFormat::text), "3\n-1\n");
  EXPECT_EQ(encode(map, OutputFormat::npy).substr(1, 5), "NUMPY");
  EXPECT_EQ(encode(map, OutputFormat::npz).substr(0, 2), "PK");
}

}  // namespace
}  // namespace spherematch
