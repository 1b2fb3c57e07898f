#include "engine/io/text_scanner.h"

#include <gtest/gtest.h>

#include <clocale>
#include <string>

#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::expect_refusal;

TEST(TextScanner, SplitsAtSpaceAndSkipsComments) {
  TextScanner scanner("  one\ttwo\r\n# a comment\nthree#another\nfour");
  EXPECT_EQ(scanner.word(), "one");
  EXPECT_EQ(scanner.word(), "two");
  EXPECT_EQ(scanner.line(), 1);
  EXPECT_EQ(scanner.word(), "three");
  EXPECT_EQ(scanner.line(), 3);
  EXPECT_EQ(scanner.word(), "four");
  EXPECT_EQ(scanner.line(), 4);
  EXPECT_EQ(scanner.word(), "");
  EXPECT_EQ(scanner.word(), "");
}

TEST(TextScanner, SkipsTheRestOfALineAndUnreads) {
  TextScanner scanner("a b c\nd");
  EXPECT_EQ(scanner.word(), "a");
  scanner.skip_line();
  EXPECT_EQ(scanner.word(), "d");
  scanner.unread(1);
  EXPECT_EQ(scanner.word(), "d");
  scanner.skip_line();
  EXPECT_EQ(scanner.remaining(), 0U);
}

TEST(TextScanner, EndsStatementsAtLineEndsUnlessABackslashJoinsThem) {
  TextScanner scanner("a b\\\nc\\x d \\\r\ne # f\\\ng\n\\", LineEnds::end_statements, 10);
  for (const char* word : {"a", "b", "c\\x", "d", "e", "", ""}) EXPECT_EQ(scanner.word(), word);
  EXPECT_EQ(scanner.line(), 12);
  scanner.skip_line();
  for (const char* word : {"g", "", ""}) EXPECT_EQ(scanner.word(), word);
  EXPECT_EQ(scanner.line(), 13);
  scanner.skip_line();
  EXPECT_EQ(scanner.word(), "\\");
  EXPECT_EQ(scanner.remaining(), 0U);
  EXPECT_EQ(scanner.place(), "line 14: ");
  // Elsewhere a backslash is a character like others.
  TextScanner plain("a\\\nb");
  EXPECT_EQ(plain.word(), "a\\");
  EXPECT_EQ(plain.word(), "b");
}

TEST(TextScanner, TellsTheEndOfALineFromThatOfTheFile) {
  const auto message = [](std::string_view text) -> std::string {
    try {
      (void)TextScanner(text, LineEnds::end_statements).integer("a count");
    } catch (const EngineError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message(" \n7"), "line 1: the line ends where a count should be");
  EXPECT_EQ(message(" "), "line 1: the file ends where a count should be");
}

TEST(TextScanner, ReadsNumbers) {
  TextScanner scanner("7 -3 +5 1.5 -2e-3 +4 .25 1e-400 0.0");
  EXPECT_EQ(scanner.integer("x"), 7);
  EXPECT_EQ(scanner.integer("x"), -3);
  EXPECT_EQ(scanner.integer("x"), 5);
  EXPECT_EQ(scanner.real("x"), 1.5);
  EXPECT_EQ(scanner.real("x"), -2e-3);
  EXPECT_EQ(scanner.real("x"), 4);
  EXPECT_EQ(scanner.real("x"), 0.25);
  EXPECT_EQ(scanner.real("x"), 0);
  EXPECT_EQ(scanner.real("x"), 0);
}

TEST(TextScanner, IgnoresTheLocale) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
    if (std::setlocale(LC_NUMERIC, name) == nullptr) continue;
    TextScanner scanner("1.5");
    EXPECT_EQ(scanner.real("x"), 1.5) << name;
  }
  std::setlocale(LC_NUMERIC, before.c_str());
}

TEST(TextScanner, RefusesWhatIsNoNumber) {
  for (const char* text : {"", "x", "1x", "1.5", "--1", "+-1", "+", "99999999999999999999"})
    expect_refusal(ErrorCode::malformed_mesh, [&] { (void)TextScanner(text).integer("a count"); });
  for (const char* text : {"", "x", "1,5", "nan", "inf", "-inf", "1e400", "-1e400", "1e", "0x10"})
    expect_refusal(ErrorCode::malformed_mesh, [&] { (void)TextScanner(text).real("a coordinate"); });
}

TEST(TextScanner, MessagesNameTheLineAndStayPrintable) {
  TextScanner scanner("1\n2\n\xFF\x01zzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzz");
  (void)scanner.integer("a count");
  (void)scanner.integer("a count");
  try {
    (void)scanner.integer("a count");
    FAIL() << "not refused";
  } catch (const EngineError& error) {
    EXPECT_STREQ(error.what(), "line 3: '??zzzzzzzzzzzzzzzzzzzzzz...' is not a count");
  }
}

}  // namespace
}  // namespace spherematch
