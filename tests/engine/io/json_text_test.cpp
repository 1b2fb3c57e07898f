#include "engine/io/json_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace spherematch {
namespace {

TEST(JsonText, ReadsBackAsTheSameText) {
  using namespace std::string_literals;
  for (const std::string& text : {""s, "leg"s, "a \"quoted\" \\ path/"s, "tab\tline\n\x01\x1f\x7f"s, "\0zero"s, "\u00e4\u20ac\U0001F408"s,
                                  "\uD7FF\uE000\uFFFF"s, "\xF4\x8F\xBF\xBF"s}) {
    EXPECT_EQ(nlohmann::json::parse(json_text(text)).get<std::string>(), text);
  }
}

TEST(JsonText, ReplacesWhatIsNotUtf8) {
  const std::string mark = "\uFFFD";
  // A lone byte, a start without its end, a long form of '/', a surrogate, and what lies beyond Unicode.
  for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{{"a\xFF"
                                                                                        "b",
                                                                                        "a" + mark + "b"},
                                                                                       {"\x80", mark},
                                                                                       {"\xC3", mark},
                                                                                       {"\xE2\x82", mark + mark},
                                                                                       {"\xC3(", mark + "("},
                                                                                       {"\xC0\xAF", mark + mark},
                                                                                       {"\xE0\x80\xAF", mark + mark + mark},
                                                                                       {"\xED\xA0\x80", mark + mark + mark},
                                                                                       {"\xF4\x90\x80\x80", mark + mark + mark + mark},
                                                                                       {"\xF0\x80\x80\x80", mark + mark + mark + mark},
                                                                                       {"\xF5\x80\x80\x80", mark + mark + mark + mark}}) {
    EXPECT_EQ(nlohmann::json::parse(json_text(text)).get<std::string>(), expected);
  }
}

}  // namespace
}  // namespace spherematch
