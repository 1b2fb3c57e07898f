#include "server/conditional.h"

#include <gtest/gtest.h>

namespace spherematch {
namespace {

TEST(Conditional, TagsAreWeakStableAndTellPartsApart) {
  const std::string tag = weak_etag({"match", "a", "b"});
  EXPECT_EQ(tag.size(), 4 + 32U);
  EXPECT_TRUE(tag.starts_with("W/\"") && tag.ends_with("\""));
  EXPECT_EQ(tag, weak_etag({"match", "a", "b"}));
  EXPECT_NE(tag, weak_etag({"match", "b", "a"}));
  EXPECT_NE(weak_etag({"ab", "c"}), weak_etag({"a", "bc"}));
  EXPECT_NE(weak_etag({"a", ""}), weak_etag({"a"}));
}

TEST(Conditional, IfNoneMatchComparesWeakly) {
  EXPECT_TRUE(names_etag("W/\"x\"", "W/\"x\""));
  EXPECT_TRUE(names_etag("\"x\"", "W/\"x\""));
  EXPECT_TRUE(names_etag("\"a\" , W/\"x\"", "W/\"x\""));
  EXPECT_TRUE(names_etag("*", "W/\"x\""));
  EXPECT_FALSE(names_etag("", "W/\"x\""));
  EXPECT_FALSE(names_etag(" , ,", "W/\"x\""));
  EXPECT_FALSE(names_etag("\"y\"", "W/\"x\""));
  EXPECT_FALSE(names_etag("x", "W/\"x\""));
}

}  // namespace
}  // namespace spherematch
