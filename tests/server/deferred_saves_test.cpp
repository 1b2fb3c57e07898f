#include "server/deferred_saves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace spherematch {
namespace {

MatchPointer some_result() { return std::make_shared<const MatchResult>(); }

TEST(DeferredSaves, FindsWhatIsNotSavedYet) {
  std::mutex disk;
  DeferredSaves saves(4);
  const MatchPointer a = some_result();
  const MatchPointer b = some_result();
  std::atomic<int> saved = 0;
  {
    const std::lock_guard busy(disk);
    const auto save = [&] {
      const std::lock_guard lock(disk);
      ++saved;
    };
    saves.add("a", a, save);
    saves.add("b", b, save);
    EXPECT_EQ(saves.find("a"), a);
    EXPECT_EQ(saves.find("b"), b);
    EXPECT_EQ(saves.find("c"), nullptr);
    EXPECT_EQ(saved, 0);
  }
  while (saves.find("b")) std::this_thread::yield();
  EXPECT_EQ(saved, 2);
  EXPECT_EQ(saves.find("a"), nullptr);
}

TEST(DeferredSaves, WhatIsDroppedIsNeitherFoundNorSaved) {
  std::mutex disk;
  std::vector<std::string> saved;
  {
    DeferredSaves saves(8);
    const std::lock_guard busy(disk);
    const MatchPointer kept = some_result();
    for (const char* key : {"a1", "b1", "a2", "b2"}) {
      saves.add(key, kept, [&, key] {
        const std::lock_guard lock(disk);
        saved.emplace_back(key);
      });
    }
    saves.drop_if([](std::string_view key) { return key.starts_with('a'); });
    EXPECT_EQ(saves.find("a1"), nullptr) << "though it may be about to be saved";
    EXPECT_EQ(saves.find("a2"), nullptr);
    EXPECT_EQ(saves.find("b1"), kept);
    EXPECT_EQ(saves.find("b2"), kept);
  }
  std::erase(saved, "a1");
  EXPECT_EQ(saved, (std::vector<std::string>{"b1", "b2"}));
}

TEST(DeferredSaves, SavesInOrderAndEverythingBeforeItEnds) {
  std::vector<int> order;
  {
    DeferredSaves saves(100);
    for (int i = 0; i < 50; ++i) saves.add(std::to_string(i), some_result(), [&order, i] { order.push_back(i); });
  }
  ASSERT_EQ(order.size(), 50U);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST(DeferredSaves, BeyondItsBoundTheCallerSaves) {
  std::mutex disk;
  std::optional<std::unique_lock<std::mutex>> busy(disk);
  DeferredSaves saves(1);
  saves.add("first", some_result(), [&] { const std::lock_guard lock(disk); });
  std::thread::id saver;
  saves.add("second", some_result(), [&] { saver = std::this_thread::get_id(); });
  EXPECT_EQ(saver, std::this_thread::get_id());
  EXPECT_EQ(saves.find("second"), nullptr);
  busy.reset();
}

}  // namespace
}  // namespace spherematch
