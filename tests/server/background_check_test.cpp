#include "server/background_check.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <stdexcept>

namespace spherematch {
namespace {

using std::chrono::milliseconds;

TEST(BackgroundCheck, AsksOncePerAgeAndOnlyWhenWanted) {
  std::atomic<int> asked = 0;
  BackgroundCheck check([&] { return "answer " + std::to_string(++asked); }, {.max_age = milliseconds(200)});
  std::this_thread::sleep_for(milliseconds(20));
  EXPECT_EQ(asked, 0);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(check.answer().detail, "answer 1");
  EXPECT_TRUE(check.answer().good);
  std::this_thread::sleep_for(milliseconds(250));
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(check.answer().detail, "answer 2");
}

TEST(BackgroundCheck, AFailureIsAnAnswerAndIsForgottenWhenItIsOver) {
  std::atomic<bool> broken = true;
  BackgroundCheck check([&]() -> std::string { return broken ? throw std::runtime_error("no space") : "fine"; },
                        {.max_age = milliseconds(20)});
  EXPECT_FALSE(check.answer().good);
  EXPECT_EQ(check.answer().detail, "no space");
  broken = false;
  std::this_thread::sleep_for(milliseconds(30));
  EXPECT_TRUE(check.answer().good);
  EXPECT_EQ(check.answer().detail, "fine");
}

TEST(BackgroundCheck, AHangIsNoticedAndNobodyWaitsForIt) {
  std::latch release(1);
  std::atomic<bool> hangs = false;
  BackgroundCheck check(
      [&]() -> std::string {
        if (hangs) release.wait();
        return "fine";
      },
      {.max_age = milliseconds(1), .patience = milliseconds(20), .too_long = milliseconds(300)});
  EXPECT_TRUE(check.answer().good);
  hangs = true;
  std::this_thread::sleep_for(milliseconds(5));
  const auto start = BackgroundCheck::Clock::now();
  EXPECT_TRUE(check.answer().good);  // the old answer, while the new one is not overdue
  EXPECT_LT(BackgroundCheck::Clock::now() - start, milliseconds(200));
  std::this_thread::sleep_for(milliseconds(350));
  EXPECT_FALSE(check.answer().good);
  release.count_down();
}

TEST(BackgroundCheck, AFirstAnswerThatDoesNotComeIsBad) {
  std::latch release(1);
  BackgroundCheck check(
      [&]() -> std::string {
        release.wait();
        return "fine";
      },
      {.patience = milliseconds(10)});
  EXPECT_FALSE(check.answer().good);
  release.count_down();
}

}  // namespace
}  // namespace spherematch
