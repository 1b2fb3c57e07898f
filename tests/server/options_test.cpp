#include "server/options.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

namespace spherematch {
namespace {

ParsedOptions parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "spherematch-server");
  return parse_options(static_cast<int>(arguments.size()), arguments.data(), "1.2.3");
}

TEST(Options, Defaults) {
  const auto [options, check, exit_code] = parse({});
  EXPECT_EQ(exit_code, std::nullopt);
  EXPECT_FALSE(check);
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

/// A configuration file, gone at the end.
class ConfigFile {
 public:
  explicit ConfigFile(const std::string& text) { std::ofstream(path_) << text; }
  ~ConfigFile() { std::filesystem::remove(path_); }
  ConfigFile(const ConfigFile&) = delete;
  ConfigFile& operator=(const ConfigFile&) = delete;
  [[nodiscard]] const char* path() const { return path_.c_str(); }

 private:
  const std::string path_ = ::testing::TempDir() + "spherematch-options-" + std::to_string(::getpid()) + ".toml";
};

/// A variable of the environment, gone at the end.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
  ~Variable() { unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

/// What is printed about arguments that end the program with 2.
std::string complaint(const std::vector<const char*>& arguments) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(parse(arguments).exit_code, 2);
  return ::testing::internal::GetCapturedStderr() + ::testing::internal::GetCapturedStdout();
}

TEST(Options, FlagBeatsVariableBeatsFileBeatsDefault) {
  const ConfigFile file("# a comment\nport = 1111\nworkers = 3   # of two\nstore = \"/a path/s.db\"\ninsecure = true\nlog-format = json\n");
  const auto with_file = parse({"--config", file.path()});
  ASSERT_EQ(with_file.exit_code, std::nullopt);
  EXPECT_EQ(with_file.options.port, 1111);
  EXPECT_EQ(with_file.options.workers, 3);
  EXPECT_EQ(with_file.options.store, "/a path/s.db");
  EXPECT_TRUE(with_file.options.insecure);
  EXPECT_EQ(with_file.options.log_format, LogFormat::json);
  EXPECT_EQ(with_file.options.waiting_matches, 16);
  const Variable port("SPHEREMATCH_PORT", "2222");
  const Variable insecure("SPHEREMATCH_INSECURE", "false");
  EXPECT_EQ(parse({"--config", file.path()}).options.port, 2222);
  EXPECT_FALSE(parse({"--config", file.path()}).options.insecure);
  EXPECT_EQ(parse({"--config", file.path()}).options.workers, 3);
  EXPECT_EQ(parse({"--config", file.path(), "--port", "3333"}).options.port, 3333);
}

TEST(Options, TheFileCanBeNamedByAVariableAndAFlagNamesAnother) {
  const Variable variable("SPHEREMATCH_CONFIG", "/nowhere/spherematch.toml");
  EXPECT_NE(complaint({}).find("/nowhere/spherematch.toml"), std::string::npos);
  const ConfigFile file("port = 1111\n");
  EXPECT_EQ(parse({"--config", file.path()}).options.port, 1111);
  const Variable right("SPHEREMATCH_CONFIG", file.path());
  EXPECT_EQ(parse({}).options.port, 1111);
}

TEST(Options, MistakesInTheFileAreErrors) {
  EXPECT_NE(complaint({"--config", "/nowhere/s.toml"}).find("/nowhere/s.toml"), std::string::npos);
  const auto complaint_about = [](const std::string& text) {
    const ConfigFile file(text);
    return complaint({"--config", file.path()});
  };
  EXPECT_NE(complaint_about("prot = 1\n").find("prot"), std::string::npos);
  EXPECT_NE(complaint_about("max_body_mib = 1\n").find("max_body_mib"), std::string::npos);
  EXPECT_NE(complaint_about("port = 65536\n").find("--port"), std::string::npos);
  EXPECT_NE(complaint_about("port = 1\nport = 2\n").find("port"), std::string::npos);
  EXPECT_NE(complaint_about("port = 1\nworkers = 1\nport = 2\n").find("port"), std::string::npos);
  EXPECT_NE(complaint_about("[server]\nport = 1\n").find("section"), std::string::npos);
  EXPECT_NE(complaint_about("store = /a path/s.db\n").find("store"), std::string::npos);
  EXPECT_NE(complaint_about("store = \"/a#b.db\"\n").find("store"), std::string::npos);
  EXPECT_NE(complaint_about("log-format = xml\n").find("log-format"), std::string::npos);
  EXPECT_NE(complaint_about("config = other.toml\n").find("config"), std::string::npos);
}

TEST(Options, HelpNamesEveryFlagWithDefaultAndVariable) {
  ::testing::internal::CaptureStdout();
  const auto exit_code = parse({"--help"}).exit_code;
  const std::string help = ::testing::internal::GetCapturedStdout();
  EXPECT_EQ(exit_code, 0);
  for (const char* text : {"--port INT:INT in [0 - 65535]=8080 (Env:SPHEREMATCH_PORT)", "--host", "--store", "--workers", "--threads",
                           "--insecure", "--config FILE", "SPHEREMATCH_CONFIG", "SPHEREMATCH_MAX_VERTICES", "SPHEREMATCH_LOG_LEVEL"}) {
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

TEST(Options, CheckNeedsNoKeys) {
  const auto parsed = parse({"--check", "--host", "0.0.0.0"});
  EXPECT_EQ(parsed.exit_code, std::nullopt);
  EXPECT_TRUE(parsed.check);
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
