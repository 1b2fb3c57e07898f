#include "server/keys_command.h"

#include <gtest/gtest.h>

#include "server/key_file.h"
#include "tests/server/temporary_directory.h"

namespace spherematch {
namespace {

struct Outcome {
  int code = 0;
  std::string out;
  std::string error;
};

Outcome run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), keys_argument);
  std::vector<const char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  const int code = keys_command(static_cast<int>(pointers.size()), pointers.data());
  const std::string out = ::testing::internal::GetCapturedStdout();
  return {code, out, ::testing::internal::GetCapturedStderr()};
}

TEST(KeysCommand, AddsListsAndRemoves) {
  const testing::TemporaryDirectory place;
  const std::string file = place.path() / "keys";
  const Outcome added = run({"add", "--keys", file, "--name", "ci", "--scope", "write"});
  EXPECT_EQ(added.code, 0) << added.error;
  ASSERT_EQ(added.out.back(), '\n');
  const auto keys = read_key_file(file);
  ASSERT_EQ(keys.size(), 1U);
  EXPECT_EQ(keys[0].sha256, sha256_of(added.out.substr(0, added.out.size() - 1)));  // the key alone is on standard output
  EXPECT_EQ(keys[0].scope, Scope::write);
  EXPECT_EQ(run({"--keys", file, "list"}).out, "ci write " + keys[0].made + "\n");
  EXPECT_EQ(run({"remove", "--keys", file, "--name", "ci"}).code, 0);
  EXPECT_EQ(run({"list", "--keys", file}).out, "");
}

TEST(KeysCommand, MistakesEndWithACodeAndAWord) {
  const testing::TemporaryDirectory place;
  const std::string file = place.path() / "keys";
  EXPECT_EQ(run({}).code, 2);
  EXPECT_EQ(run({"add", "--name", "ci"}).code, 2);
  EXPECT_EQ(run({"add", "--keys", file}).code, 2);
  EXPECT_EQ(run({"add", "--keys", file, "--name", "ci", "--scope", "all"}).code, 2);
  EXPECT_EQ(run({"list", "--keys", file}).code, 1);
  const Outcome missing = run({"remove", "--keys", file, "--name", "ci"});
  EXPECT_EQ(missing.code, 1);
  EXPECT_NE(missing.error.find("no key named ci"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_EQ(run({"--help"}).code, 0);
}

}  // namespace
}  // namespace spherematch
