#include "server/key_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <sstream>
#include <thread>

#include "tests/server/temporary_directory.h"

namespace spherematch {
namespace {

const std::string digest(64, 'a');

std::string complaint(const std::string& text) {
  try {
    (void)parse_keys(text);
  } catch (const KeyFileError& error) {
    return error.what();
  }
  return {};
}

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(KeyFile, ReadsNamesScopesDigestsAndDates) {
  const auto keys = parse_keys("# a comment\n\n  ci   write " + digest + " 2024-01-31\r\nme admin " + digest + " 2024-02-01");
  ASSERT_EQ(keys.size(), 2U);
  EXPECT_EQ(keys[0], (Key{"ci", Scope::write, digest, "2024-01-31"}));
  EXPECT_EQ(keys[1].scope, Scope::admin);
  EXPECT_TRUE(parse_keys("").empty());
}

TEST(KeyFile, MistakesAreNamedByTheirLine) {
  EXPECT_NE(complaint("# c\nci write " + digest).find("line 2"), std::string::npos);
  EXPECT_NE(complaint("ci write " + digest + " d e").find("line 1"), std::string::npos);
  EXPECT_NE(complaint("ci all " + digest + " d").find("scope"), std::string::npos);
  EXPECT_NE(complaint("ci/ read " + digest + " d").find("name"), std::string::npos);
  EXPECT_NE(complaint("ci read " + std::string(64, 'A') + " d").find("hex"), std::string::npos);
  EXPECT_NE(complaint("ci read abc d").find("hex"), std::string::npos);
  EXPECT_NE(complaint("a read " + digest + " d\n\na read " + digest + " d").find("line 3: there is another"), std::string::npos);
}

TEST(KeyFile, Sha256IsTheStandards) {
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_TRUE(equal_in_constant_time(digest, digest));
  EXPECT_FALSE(equal_in_constant_time(digest, digest.substr(1) + "b"));
  EXPECT_FALSE(equal_in_constant_time(digest, ""));
}

TEST(KeyFile, AddsAndRemovesAndKeepsComments) {
  const testing::TemporaryDirectory place;
  const auto file = place.path() / "keys";
  const std::string first = add_key(file, "one", Scope::read);
  const std::string second = add_key(file, "two", Scope::admin);
  EXPECT_NE(first, second);
  EXPECT_EQ(first.size(), 3U + 64U);
  auto keys = read_key_file(file);
  ASSERT_EQ(keys.size(), 2U);
  EXPECT_EQ(keys[0].name, "one");
  EXPECT_EQ(keys[0].sha256, sha256_of(first));
  EXPECT_EQ(keys[1].sha256, sha256_of(second));
  EXPECT_EQ(keys[1].scope, Scope::admin);
  EXPECT_EQ(content(file).find(first), std::string::npos);  // the key itself is nowhere
  std::ofstream(file, std::ios::app) << "# a remark";
  EXPECT_THROW((void)add_key(file, "one", Scope::read), KeyFileError);
  EXPECT_THROW((void)add_key(file, "a b", Scope::read), KeyFileError);
  remove_key(file, "one");
  (void)add_key(file, "three", Scope::write);
  EXPECT_NE(content(file).find("# a remark\n"), std::string::npos);
  keys = read_key_file(file);
  ASSERT_EQ(keys.size(), 2U);
  EXPECT_EQ(keys[0].name, "two");
  EXPECT_EQ(keys[1].name, "three");
  EXPECT_THROW(remove_key(file, "one"), KeyFileError);
}

TEST(KeyFile, IsForItsOwnerAloneAndKeepsALink) {
  const testing::TemporaryDirectory place;
  const auto file = place.path() / "keys";
  std::ofstream(file) << "";
  std::filesystem::permissions(file, std::filesystem::perms(0644));
  const auto link = place.path() / "link";
  std::filesystem::create_symlink(file, link);
  (void)add_key(link, "one", Scope::read);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  struct stat status {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
  EXPECT_EQ(read_key_file(file).size(), 1U);
}

TEST(KeyFile, ABrokenFileIsNotChanged) {
  const testing::TemporaryDirectory place;
  const auto file = place.path() / "keys";
  std::ofstream(file) << "nonsense\n";
  EXPECT_THROW((void)add_key(file, "one", Scope::read), KeyFileError);
  EXPECT_EQ(content(file), "nonsense\n");
  EXPECT_THROW((void)read_key_file(place.path() / "missing"), KeyFileError);
  EXPECT_THROW((void)add_key(place.path() / "missing" / "keys", "one", Scope::read), KeyFileError);
}

TEST(KeyFile, ChangesAtTheSameTimeAreAllKept) {
  const testing::TemporaryDirectory place;
  const auto file = place.path() / "keys";
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i) threads.emplace_back([&, i] { (void)add_key(file, "k" + std::to_string(i), Scope::read); });
  }
  EXPECT_EQ(read_key_file(file).size(), 8U);
}

}  // namespace
}  // namespace spherematch
