#include "server/event_log.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace spherematch {
namespace {

TEST(EventLog, PlainValuesStandBareInText) {
  EXPECT_EQ(event_line(LogFormat::text, "request", {{"method", "GET"}, {"status", 200}, {"ms", 1.25}, {"saved", true}}),
            "event=request method=GET status=200 ms=1.250 saved=true");
  EXPECT_EQ(event_line(LogFormat::text, "stopped", {}), "event=stopped");
}

TEST(EventLog, ValuesThatCouldBeMisreadAreQuoted) {
  const auto text = [](std::string_view value) { return event_line(LogFormat::text, "e", {{"k", value}}); };
  EXPECT_EQ(text("two words"), R"(event=e k="two words")");
  EXPECT_EQ(text("say \"no\""), R"(event=e k="say \"no\"")");
  EXPECT_EQ(text("a=b"), R"(event=e k="a=b")");
  EXPECT_EQ(text(""), R"(event=e k="")");
  EXPECT_EQ(text("back\\slash"), R"(event=e k="back\\slash")");
  EXPECT_EQ(text("x\nlevel=error event=forged"), R"(event=e k="x\nlevel=error event=forged")");
  EXPECT_EQ(text("\x1b[2J"), R"(event=e k="\u001b[2J")");
}

TEST(EventLog, JsonKeepsTypesAndEveryText) {
  const std::string odd = "say \"no\"\n\\ \xc3\xbc";
  std::string line = "{";
  line += event_line(LogFormat::json, "e", {{"text", odd}, {"count", std::size_t{3}}, {"ms", 0.5}, {"ok", false}});
  line += "}";
  const auto json = nlohmann::json::parse(line);
  EXPECT_EQ(json, (nlohmann::json{{"event", "e"}, {"text", odd}, {"count", 3}, {"ms", 0.5}, {"ok", false}}));
}

TEST(EventLog, BytesThatAreNoTextDoNotBreakTheLine) {
  for (const LogFormat format : {LogFormat::text, LogFormat::json}) {
    const std::string line = event_line(format, "e", {{"k", "a\xff\xfe z"}});
    EXPECT_NE(line.find("a\xef\xbf\xbd"), std::string::npos) << line;
    EXPECT_EQ(line.find('\xff'), std::string::npos);
  }
}

}  // namespace
}  // namespace spherematch
