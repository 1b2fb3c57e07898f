#include "engine/io/map_format.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "engine/io/map_writer.h"
#include "tests/engine/io/some_maps.h"

namespace spherematch::test {
namespace {

TEST(MapFormat, EveryNameIsKnownAndEncodes) {
  const PolygonMesh mesh = polygons(icosphere(2));
  const Surface surface = repair(mesh, RepairMode::none);
  const Correspondence map = identity_map(surface);
  const std::vector<std::string_view> names = map_format_names();
  EXPECT_EQ(names, (std::vector<std::string_view>{"npz", "npy", "txt", "map", "ply", "glb", "obj", "png"}));
  const std::vector<std::string> beginnings{"PK", "\x93NUMPY", "0\n1\n", "1\n2\n", "ply\n", "glTF", "# ", "\x89PNG\r\n"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const MapFormat format = map_format_of(names[i]).value();
    const std::string bytes = encode_map(format, map, surface, surface, needs_source_mesh(format) ? mesh : PolygonMesh{});
    EXPECT_TRUE(bytes.starts_with(beginnings[i])) << names[i];
    const VertexQuality quality{.distortion = std::vector<float>(map.vertex.size(), 0.5F), .confidence = {}};
    const std::string judged = encode_map(format, map, surface, surface, needs_source_mesh(format) ? mesh : PolygonMesh{}, quality);
    EXPECT_EQ(judged.find("distortion") != std::string::npos, holds_quality(format)) << names[i];
    EXPECT_EQ(judged.find("confidence"), std::string::npos) << names[i];
    EXPECT_EQ(judged == bytes, !holds_quality(format)) << names[i];
    if (needs_source_mesh(format)) {
      EXPECT_THROW((void)encode_map(format, map, surface, surface), std::invalid_argument);
    }
  }
  for (const char* unknown : {"", "json", "PLY", "ply "}) EXPECT_EQ(map_format_of(unknown), std::nullopt);
}

}  // namespace
}  // namespace spherematch::test
