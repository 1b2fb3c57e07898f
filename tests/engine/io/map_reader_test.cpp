#include "engine/io/map_reader.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "engine/io/map_writer.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

Correspondence some_map() {
  Correspondence map;
  map.vertex = {2, -1, 0};
  map.corners.resize(3, 3);
  map.corners << 2, 1, 0, -1, -1, -1, 0, 1, 3;
  map.bary.resize(3, 3);
  map.bary << 0.5F, 0.25F, 0.25F, 0, 0, 0, 1, 0, 0;
  return map;
}

TEST(DecodeNpz, ReadsWhatEncodeNpzWrites) {
  const Correspondence map = some_map(), read = decode_npz(bytes_of(encode_npz(map)));
  EXPECT_EQ(read.vertex, map.vertex);
  EXPECT_EQ(read.corners, map.corners);
  EXPECT_EQ(read.bary, map.bary);
  EXPECT_TRUE(decode_npz(bytes_of(encode_npz(Correspondence{{}, Triangles(0, 3), {}}))).vertex.empty());
}

TEST(DecodeNpz, RefusesDamagedBytes) {
  const std::string good = encode_npz(some_map());
  for (std::size_t length = 0; length < good.size(); ++length)
    test::expect_refusal(ErrorCode::malformed_mesh, [&] { (void)decode_npz(bytes_of(good.substr(0, length))); });
  // One byte changed anywhere: refused, or a byte that the numbers do not depend on. The archive has checksums.
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x15);
    try {
      EXPECT_EQ(decode_npz(bytes_of(bad)).vertex, some_map().vertex) << "byte " << at;
    } catch (const EngineError& error) {
      EXPECT_EQ(error.code(), ErrorCode::malformed_mesh);
    }
  }
}

TEST(DecodeNpz, RefusesNumbersThatNoMapHas) {
  Correspondence index = some_map(), weight = some_map();
  index.corners(0, 1) = -7;
  weight.bary(0, 0) = std::numeric_limits<float>::quiet_NaN();
  for (const Correspondence& map : {index, weight})
    test::expect_refusal(ErrorCode::malformed_mesh, [&] { (void)decode_npz(bytes_of(encode_npz(map))); });
}

TEST(ReadLandmarks, CountsFromOne) {
  EXPECT_EQ(read_landmarks("1\n42 7\r\n\n3"), (std::vector<std::int32_t>{0, 41, 6, 2}));
  EXPECT_TRUE(read_landmarks("").empty());
  for (const char* text : {"0", "-1", "1.5", "x", "1\n99999999999999999999", "2147483648"})
    test::expect_refusal(ErrorCode::malformed_mesh, [&] { (void)read_landmarks(text); });
}

TEST(ReadIndices, CountsFromZeroWithMinusOneForNone) {
  EXPECT_EQ(read_indices("0\n-1 7\n"), (std::vector<std::int32_t>{0, -1, 7}));
  EXPECT_TRUE(read_indices("").empty());
  for (const char* text : {"-2", "0.5", "x", "2147483648"})
    test::expect_refusal(ErrorCode::malformed_mesh, [&] { (void)read_indices(text); });
}

TEST(MapReader, ListsFromOneHaveZeroForNone) {
  EXPECT_EQ(read_list_from_one("1\n0 8\n"), (std::vector<std::int32_t>{0, -1, 7}));
  EXPECT_TRUE(read_list_from_one("").empty());
  for (const char* text : {"-1", "0.5", "x", "2147483648"})
    test::expect_refusal(ErrorCode::malformed_mesh, [&] { (void)read_list_from_one(text); });
}

}  // namespace
}  // namespace spherematch
