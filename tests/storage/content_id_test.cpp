#include "storage/content_id.h"

#include <gtest/gtest.h>

#include <string>

#include "storage/upload_options.h"

namespace spherematch {
namespace {

ContentId id_of(std::string_view text, std::string_view options) { return content_id(std::as_bytes(std::span(text)), options); }

// The digests are what coreutils' sha256sum prints for the same bytes.
TEST(ContentId, IsTheStandardDigest) {
  const ContentId content = id_of("abc", "repair=fill");
  EXPECT_EQ(content.sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(content.id, std::string("c24300fb8cd13a91a2a46890540c23c197bcb656f171f8f42926eecd6597ab50").substr(0, 32));
  EXPECT_EQ(content.options, "repair=fill");
  EXPECT_EQ(id_of("", "").sha256, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(ContentId, DependsOnBytesAndOptions) {
  const ContentId fill = id_of("abc", "repair=fill");
  EXPECT_NE(fill.id, id_of("abc", "repair=none").id);
  EXPECT_EQ(fill.sha256, id_of("abc", "repair=none").sha256);
  EXPECT_NE(fill.id, id_of("abd", "repair=fill").id);
  EXPECT_NE(id_of("abcrepair=", "fill").id, fill.id);  // where one ends and the other begins counts
}

// Stored: shapes of earlier releases must be found again.
TEST(ContentId, OptionsHaveOneText) {
  EXPECT_EQ(upload_options({}), "repair=fill");
  EXPECT_EQ(upload_options({.repair = RepairMode::none}), "repair=none");
  EXPECT_EQ(upload_options({.repair = RepairMode::fill, .simplify = 5000}), "repair=fill;simplify=5000");
  EXPECT_EQ(upload_options({.repair = RepairMode::none, .simplify = 500}), "repair=none;simplify=500");
}

TEST(ContentId, RecognisesItsForm) {
  EXPECT_TRUE(is_shape_id(id_of("abc", "").id));
  EXPECT_TRUE(is_shape_id("0123456789abcdef0123456789abcdef"));
  EXPECT_FALSE(is_shape_id(""));
  EXPECT_FALSE(is_shape_id("0123456789abcdef0123456789abcde"));
  EXPECT_FALSE(is_shape_id("0123456789abcdef0123456789abcdef0"));
  EXPECT_FALSE(is_shape_id("0123456789ABCDEF0123456789abcdef"));
  EXPECT_FALSE(is_shape_id("0123456789abcdef0123456789abcdeg"));
}

}  // namespace
}  // namespace spherematch
