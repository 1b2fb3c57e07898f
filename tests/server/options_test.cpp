#include "server/options.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

namespace spherematch {
namespace {

ParsedOptions parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "spherematch-server");
  return parse_options(static_cast<int>(arguments.size()), arguments.data(), "1.2.3");
}

TEST(Options, Defaults) {
  const auto [options, exit_code] = parse({});
  EXPECT_EQ(exit_code, std::nullopt);
  EXPECT_EQ(options.host, "127.0.0.1");
  EXPECT_EQ(options.port, 8080);
  EXPECT_EQ(options.store, "data/spherematch.db");
  EXPECT_EQ(options.max_body_bytes(), 64U * 1024 * 1024);
  EXPECT_EQ(options.max_vertices, 300'000);
  EXPECT_GE(options.threads, 1);
  EXPECT_GE(options.concurrent_matches, 1);
}

TEST(Options, FlagsOverrideTheEnvironment) {
  setenv("SPHEREMATCH_PORT", "1234", 1);
  setenv("SPHEREMATCH_MAX_BODY_MIB", "7", 1);
  EXPECT_EQ(parse({}).options.port, 1234);
  EXPECT_EQ(parse({}).options.max_body_mib, 7);
  EXPECT_EQ(parse({"--port", "0"}).options.port, 0);
  unsetenv("SPHEREMATCH_PORT");
  unsetenv("SPHEREMATCH_MAX_BODY_MIB");
}

TEST(Options, HelpNamesEveryFlagWithDefaultAndVariable) {
  ::testing::internal::CaptureStdout();
  const auto exit_code = parse({"--help"}).exit_code;
  const std::string help = ::testing::internal::GetCapturedStdout();
  EXPECT_EQ(exit_code, 0);
  for (const char* text : {"--port INT:INT in [0 - 65535]=8080 (Env:SPHEREMATCH_PORT)", "--host", "--store", "--workers", "--threads",
                           "--insecure", "SPHEREMATCH_MAX_VERTICES", "SPHEREMATCH_LOG_LEVEL"}) {
    EXPECT_NE(help.find(text), std::string::npos) << text;
  }
}

TEST(Options, BadFlagsEndWithTwo) {
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(parse({"--port", "65536"}).exit_code, 2);
  EXPECT_EQ(parse({"--port", "x"}).exit_code, 2);
  EXPECT_EQ(parse({"--bogus"}).exit_code, 2);
  EXPECT_EQ(parse({"--workers", "0"}).exit_code, 2);
  EXPECT_EQ(parse({"--host", "0.0.0.0"}).exit_code, 2);
  EXPECT_NE(::testing::internal::GetCapturedStderr().find("--insecure"), std::string::npos);
  EXPECT_EQ(parse({"--host", "0.0.0.0", "--insecure"}).exit_code, std::nullopt);
}

TEST(Options, LoopbackIsToldFromNames) {
  for (const char* host : {"127.0.0.1", "127.255.0.9", "localhost", "::1"}) EXPECT_TRUE(is_loopback(host)) << host;
  for (const char* host :
       {"0.0.0.0", "128.0.0.1", "127.0.0.1.example.org", "127.example.org", "127.1", "", "::", "127.0.0.256", "127.0.0.1.", "127.0.0.-1"}) {
    EXPECT_FALSE(is_loopback(host)) << host;
  }
}

}  // namespace
}  // namespace spherematch
