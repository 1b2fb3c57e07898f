#include "server/shape_labels.h"

#include <gtest/gtest.h>

#include "server/problem.h"

namespace spherematch {
namespace {

using Tags = std::vector<std::string>;

TEST(ShapeLabels, TagsAreSeparatedByCommas) {
  EXPECT_EQ(parse_tags(""), Tags{});
  EXPECT_EQ(parse_tags("a"), Tags{"a"});
  EXPECT_EQ(parse_tags("b,a,part:left_1.2-x,b"), (Tags{"b", "a", "part:left_1.2-x", "b"}));
  EXPECT_EQ(parse_tags(std::string(max_tag_bytes, 'x')).size(), 1U);
}

TEST(ShapeLabels, OtherTagsAreRefused) {
  for (const std::string& text : {std::string(","), std::string("a,"), std::string(",a"), std::string("a b"), std::string("\xC3\xA4"),
                                  std::string("a\n"), std::string("a,,b"), std::string(max_tag_bytes + 1, 'x'), std::string("a/b")}) {
    EXPECT_THROW((void)parse_tags(text), ProblemError) << text;
  }
  std::string many = "x";
  for (std::size_t i = 1; i < max_tags; ++i) many += ",x" + std::to_string(i);
  EXPECT_EQ(parse_tags(many).size(), max_tags);
  EXPECT_THROW((void)parse_tags(many + ",more"), ProblemError);
}

TEST(ShapeLabels, NamesAreShortAndPrintable) {
  EXPECT_NO_THROW(check_name(""));
  EXPECT_NO_THROW(check_name(std::string(max_name_bytes, 'x')));
  EXPECT_NO_THROW(check_name("B\xC3\xA4r \"1\"/2"));
  EXPECT_THROW(check_name(std::string(max_name_bytes + 1, 'x')), ProblemError);
  EXPECT_THROW(check_name("a\tb"), ProblemError);
  EXPECT_THROW(check_name(std::string("a\0b", 3)), ProblemError);
  EXPECT_THROW(check_name("\x7f"), ProblemError);
}

TEST(ShapeLabels, FileNamesAreMadeToFit) {
  EXPECT_EQ(name_of_file("../../etc/c\nat.off"), "cat.off");
  EXPECT_EQ(name_of_file("C:\\meshes\\cat.off"), "cat.off");
  EXPECT_EQ(name_of_file("folder/"), "");
  EXPECT_EQ(name_of_file(std::string(500, 'x')).size(), max_name_bytes);
}

}  // namespace
}  // namespace spherematch
