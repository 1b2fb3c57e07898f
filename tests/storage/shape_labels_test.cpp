// Names and tags of stored shapes, and the lists that they select.
#include <SQLiteCpp/Database.h>
#include <gtest/gtest.h>

#include <thread>

#include "tests/storage/store_file.h"

namespace spherematch {
namespace {

using testing::insert;
using testing::sample_prepared;
using testing::SampleUpload;

using Tags = std::vector<std::string>;

class ShapeLabelsTest : public ::testing::Test {
 protected:
  std::string put(unsigned number, const ShapeLabels& labels) {
    const SampleUpload upload(number);
    insert(store_, upload, labels);
    return upload.content.id;
  }
  std::vector<std::string> listed(const ShapeFilter& filter) {
    std::vector<std::string> ids;
    for (const ShapeRecord& record : store_.list(100, std::nullopt, filter).shapes) ids.push_back(record.id);
    return ids;
  }
  int count(const std::string& table) {
    SQLite::Database database(file_.path().string());
    return database.execAndGet("SELECT count(*) FROM " + table).getInt();
  }

  testing::StoreFile file_;
  ShapeStore store_{file_.path()};
};

TEST_F(ShapeLabelsTest, TagsAreASet) {
  const std::string id = put(1, {.name = "cat", .format = "ply", .tags = {"b", "a", "b", "A"}});
  EXPECT_EQ(store_.find(id)->tags, (Tags{"A", "a", "b"}));
  EXPECT_EQ(store_.find(id)->format, "ply");
  EXPECT_EQ(store_.list(1).shapes.at(0).tags, (Tags{"A", "a", "b"}));
}

TEST_F(ShapeLabelsTest, TheFirstLabelsStay) {
  const std::string id = put(1, {.name = "cat", .format = "ply", .tags = {"a"}});
  put(1, {.name = "dog", .format = "off", .tags = {"b"}});
  EXPECT_EQ(store_.find(id)->name, "cat");
  EXPECT_EQ(store_.find(id)->format, "ply");
  EXPECT_EQ(store_.find(id)->tags, Tags{"a"});
}

TEST_F(ShapeLabelsTest, OnlyWhatIsSetChanges) {
  const std::string id = put(1, {.name = "cat", .format = "ply", .tags = {"a", "b"}});
  const std::string other = put(2, {.name = "dog", .format = "off", .tags = {"a"}});
  EXPECT_EQ(store_.change(id, {.name = "", .tags = {}}), ChangeOutcome::changed);
  EXPECT_EQ(store_.find(id)->name, "");
  EXPECT_EQ(store_.find(id)->tags, (Tags{"a", "b"}));
  EXPECT_EQ(store_.change(id, {.name = {}, .tags = Tags{"c"}}), ChangeOutcome::changed);
  EXPECT_EQ(store_.find(id)->tags, Tags{"c"});
  EXPECT_EQ(store_.change(id, {.name = "lynx", .tags = Tags{}}), ChangeOutcome::changed);
  EXPECT_EQ(store_.find(id)->name, "lynx");
  EXPECT_EQ(store_.find(id)->tags, Tags{});
  EXPECT_EQ(store_.find(id)->format, "ply");
  EXPECT_EQ(store_.find(other)->name, "dog");
  EXPECT_EQ(store_.find(other)->tags, Tags{"a"});
  EXPECT_EQ(store_.change(std::string(32, '0'), {.name = "x", .tags = {}}), ChangeOutcome::not_found);
}

TEST_F(ShapeLabelsTest, ARefusedChangeChangesNothing) {
  const std::string id = put(1, {.name = "cat", .format = "ply", .tags = {"a"}});
  std::string seen;
  const auto refuse = [&](const ShapeRecord& record) {
    seen = record.name;
    return false;
  };
  EXPECT_EQ(store_.change(id, {.name = "dog", .tags = Tags{}}, refuse), ChangeOutcome::refused);
  EXPECT_EQ(seen, "cat");
  EXPECT_EQ(store_.find(id)->name, "cat");
  EXPECT_EQ(store_.find(id)->tags, Tags{"a"});
}

TEST_F(ShapeLabelsTest, OfChangesToTheSameStateOneWins) {
  const std::string id = put(1, {.name = "start", .format = "", .tags = {}});
  std::atomic<int> changed = 0;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i) {
      threads.emplace_back([&, i] {
        const auto untouched = [](const ShapeRecord& record) { return record.name == "start"; };
        if (store_.change(id, {.name = std::to_string(i), .tags = {}}, untouched) == ChangeOutcome::changed) ++changed;
      });
    }
  }
  EXPECT_EQ(changed, 1);
}

TEST_F(ShapeLabelsTest, TagsGoWithTheirShape) {
  const std::string id = put(1, {.name = "", .format = "", .tags = {"a", "b"}});
  put(2, {.name = "", .format = "", .tags = {"a"}});
  store_.remove(id);
  EXPECT_EQ(count("shape_tags"), 1);
}

TEST_F(ShapeLabelsTest, FiltersSelect) {
  const std::string cat = put(1, {.name = "Black Cat", .format = "", .tags = {"animal", "cat"}});
  const std::string dog = put(2, {.name = "dog", .format = "", .tags = {"animal"}});
  const std::string bone = put(3, {.name = "bone 100%", .format = "", .tags = {"part:left"}});
  store_.save_prepared(dog, sample_prepared(SampleUpload(2).surface));
  store_.mark_processing(bone);
  store_.mark_failed(bone, "code", "detail");

  EXPECT_EQ(listed({}), (Tags{bone, dog, cat}));
  EXPECT_EQ(listed({.state = ShapeState::ready, .tag = {}, .name_part = {}, .sha256 = {}}), Tags{dog});
  EXPECT_EQ(listed({.state = ShapeState::failed, .tag = {}, .name_part = {}, .sha256 = {}}), Tags{bone});
  EXPECT_EQ(listed({.state = ShapeState::processing, .tag = {}, .name_part = {}, .sha256 = {}}), Tags{});
  EXPECT_EQ(listed({.state = {}, .tag = "animal", .name_part = {}, .sha256 = {}}), (Tags{dog, cat}));
  EXPECT_EQ(listed({.state = {}, .tag = "Animal", .name_part = {}, .sha256 = {}}), Tags{});
  EXPECT_EQ(listed({.state = ShapeState::queued, .tag = "animal", .name_part = {}, .sha256 = {}}), Tags{cat});
  EXPECT_EQ(listed({.state = {}, .tag = {}, .name_part = "BLACK", .sha256 = {}}), Tags{cat});
  EXPECT_EQ(listed({.state = {}, .tag = {}, .name_part = "k c", .sha256 = {}}), Tags{cat});
  // Signs that a pattern would give a meaning to stand for themselves.
  EXPECT_EQ(listed({.state = {}, .tag = {}, .name_part = "%", .sha256 = {}}), Tags{bone});
  EXPECT_EQ(listed({.state = {}, .tag = {}, .name_part = "d_g", .sha256 = {}}), Tags{});
  EXPECT_EQ(listed({.state = {}, .tag = {}, .name_part = {}, .sha256 = SampleUpload(2).content.sha256}), Tags{dog});
  EXPECT_EQ(listed({.state = {}, .tag = "cat", .name_part = {}, .sha256 = SampleUpload(2).content.sha256}), Tags{});
}

TEST_F(ShapeLabelsTest, PagesOfAFilteredListHaveNoGaps) {
  std::vector<std::string> expected;
  for (unsigned i = 0; i < 12; ++i) {
    const bool tagged = i % 3 != 0;
    const std::string id = put(i, {.name = "", .format = "", .tags = tagged ? Tags{"odd"} : Tags{}});
    if (tagged) expected.insert(expected.begin(), id);
  }
  std::vector<std::string> seen;
  std::optional<std::string> cursor;
  do {
    const ShapePage page = store_.list(3, cursor, {.state = {}, .tag = "odd", .name_part = {}, .sha256 = {}});
    EXPECT_LE(page.shapes.size(), 3U);
    for (const ShapeRecord& record : page.shapes) seen.push_back(record.id);
    cursor = page.next_cursor;
  } while (cursor);
  EXPECT_EQ(seen, expected);
}

}  // namespace
}  // namespace spherematch
