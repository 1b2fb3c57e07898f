#include "engine/io/byte_reader.h"

#include <gtest/gtest.h>

#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::expect_refusal;

using namespace std::string_view_literals;
constexpr std::string_view bytes = "\x01\x02\x03\x04\xFF\xC0\x00\x00"sv;

TEST(ByteReader, ReadsBothByteOrders) {
  ByteReader little(bytes.substr(0, 5));
  EXPECT_EQ(little.read<std::uint32_t>("x"), 0x04030201U);
  EXPECT_EQ(little.read<std::int8_t>("x"), -1);
  EXPECT_EQ(little.remaining(), 0U);
  ByteReader big(bytes, 0, std::endian::big);
  EXPECT_EQ(big.read<std::uint16_t>("x"), 0x0102U);
  big.skip(3, "x");
  EXPECT_EQ(big.read<std::uint8_t>("x"), 0xC0U);
  const std::string number("\xC0\x04\0\0\0\0\0\0", 8);
  EXPECT_EQ(ByteReader(number, 0, std::endian::big).read<double>("x"), -2.5);
}

TEST(ByteReader, StopsAtTheEndNamingTheByte) {
  ByteReader reader(bytes.substr(0, 5), 100);
  reader.skip(2, "x");
  EXPECT_EQ(reader.place(), "byte 102: ");
  expect_refusal(ErrorCode::malformed_mesh, [&] { (void)reader.read<std::uint32_t>("a count"); });
  expect_refusal(ErrorCode::malformed_mesh, [&] { reader.skip(4, "a count"); });
  EXPECT_EQ(reader.read<std::uint16_t>("x"), 0x0403U) << "a refusal moves nothing";
  try {
    (void)reader.read<std::uint16_t>("a count");
    FAIL() << "not refused";
  } catch (const EngineError& error) {
    EXPECT_STREQ(error.what(), "byte 104: the file ends where a count should be");
  }
}

}  // namespace
}  // namespace spherematch
