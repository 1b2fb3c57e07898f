#include "api/error_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

namespace spherematch::api {
namespace {

TEST(ErrorTable, WireStringsAreDistinctHyphenatedWords) {
  std::set<std::string_view> seen;
  for (const ErrorEntry& entry : error_table()) {
    EXPECT_TRUE(seen.insert(entry.wire).second) << entry.wire;
    EXPECT_FALSE(entry.wire.empty());
    EXPECT_TRUE(std::all_of(entry.wire.begin(), entry.wire.end(), [](char c) { return (c >= 'a' && c <= 'z') || c == '-'; })) << entry.wire;
    EXPECT_FALSE(entry.title.empty()) << entry.wire;
  }
}

TEST(ErrorTable, StatusesAreErrorsAndOnlyServerOrStateErrorsAreRetryable) {
  for (const ErrorEntry& entry : error_table()) {
    EXPECT_GE(entry.status, 400) << entry.wire;
    EXPECT_LT(entry.status, 600) << entry.wire;
    EXPECT_EQ(entry.retryable, entry.status >= 500 || entry.code == Code::shape_not_ready) << entry.wire;
  }
}

TEST(ErrorTable, LookupsAgree) {
  for (const ErrorEntry& entry : error_table()) {
    EXPECT_EQ(&entry_of(entry.code), &entry);
    EXPECT_EQ(code_from_wire(entry.wire), entry.code);
  }
  EXPECT_EQ(code_from_wire("no-such-code"), std::nullopt);
  EXPECT_EQ(code_from_wire(""), std::nullopt);
}

TEST(ErrorTable, DocumentationListsEveryCodeWithItsStatus) {
  std::ifstream file(std::string(SOURCE_DIR) + "/docs/http.md");
  ASSERT_TRUE(file);
  std::string line;
  std::set<std::string> rows;
  while (std::getline(file, line)) rows.insert(line);
  for (const ErrorEntry& entry : error_table()) {
    const std::string start = "| `" + std::string(entry.wire) + "` | " + std::to_string(entry.status) + " | ";
    EXPECT_EQ(std::count_if(rows.begin(), rows.end(), [&](const std::string& row) { return row.starts_with(start); }), 1)
        << "docs/http.md needs one row starting with: " << start;
  }
}

TEST(ErrorTable, DocumentationListsNoOtherCode) {
  std::ifstream file(std::string(SOURCE_DIR) + "/docs/http.md");
  std::string line;
  bool in_table = false;
  int rows = 0;
  while (std::getline(file, line)) {
    if (line.starts_with("| `code` |")) in_table = true;
    if (line.empty()) in_table = false;
    if (!in_table || !line.starts_with("| `") || line.starts_with("| `code` |")) continue;
    const std::string wire = line.substr(3, line.find('`', 3) - 3);
    EXPECT_TRUE(code_from_wire(wire).has_value()) << wire;
    ++rows;
  }
  EXPECT_EQ(rows, static_cast<int>(error_table().size()));
}

}  // namespace
}  // namespace spherematch::api
