#include "cli/output_format.h"

#include <gtest/gtest.h>

namespace spherematch {
namespace {

TEST(OutputFormat, FollowsTheExtension) {
  EXPECT_EQ(output_format_of("map.npz"), MapFormat::npz);
  EXPECT_EQ(output_format_of("a.b/MAP.NPY"), MapFormat::npy);
  EXPECT_EQ(output_format_of("map.txt"), MapFormat::text);
  EXPECT_EQ(output_format_of("a_b.map"), MapFormat::list_from_one);
  EXPECT_EQ(output_format_of("map.Ply"), MapFormat::ply);
  EXPECT_EQ(output_format_of("map.glb"), MapFormat::glb);
  EXPECT_EQ(output_format_of("map.obj"), MapFormat::obj);
  EXPECT_EQ(output_format_of("picture.png"), MapFormat::png);
  for (const char* file : {"map", "map.json", "npz", ".npz", "map.npz/", "map.npz.gz", "map.", ""})
    EXPECT_EQ(output_format_of(file), std::nullopt) << file;
}

TEST(OutputFormat, NamesWhatIsSupported) { EXPECT_EQ(supported_extensions(), ".npz, .npy, .txt, .map, .ply, .glb, .obj, .png"); }

}  // namespace
}  // namespace spherematch
