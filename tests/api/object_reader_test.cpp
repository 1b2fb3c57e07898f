#include "api/object_reader.h"

#include <gtest/gtest.h>

namespace spherematch::api {
namespace {

TEST(ObjectReader, DeepNestingIsRefusedWithoutRecursion) {
  std::string text(1'000'000, '[');
  EXPECT_THROW((void)parse(text), JsonError);
  EXPECT_NO_THROW((void)parse(std::string(16, '[') + std::string(16, ']')));
  EXPECT_THROW((void)parse(std::string(18, '[') + std::string(18, ']')), JsonError);
}

TEST(ObjectReader, FinishNamesWhatNobodyAskedFor) {
  const Json json = parse(R"({"a":1,"b":{"c":2}})");
  ObjectReader reader(json, "here");
  EXPECT_EQ(reader.integer("a", 0, 5), 1);
  try {
    reader.finish();
    FAIL() << "accepted an unknown member";
  } catch (const JsonError& error) {
    EXPECT_STREQ(error.what(), "here.b: is not a known member");
  }
  EXPECT_TRUE(reader.member("b").is_object());
  EXPECT_NO_THROW(reader.finish());
}

TEST(ObjectReader, NumbersKeepTheirBounds) {
  const Json json = parse(R"({"least":-3,"most":9223372036854775807,"over":9223372036854775808})");
  ObjectReader reader(json, "");
  EXPECT_EQ(reader.integer("least", -3, 0), -3);
  EXPECT_THROW((void)reader.integer("least", -2, 0), JsonError);
  EXPECT_EQ(reader.integer("most", 0, INT64_MAX), INT64_MAX);
  EXPECT_THROW((void)reader.integer("over", 0, INT64_MAX), JsonError);
}

}  // namespace
}  // namespace spherematch::api
