#include "server/byte_budget.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace spherematch {
namespace {

TEST(ByteBudget, SharesGrowUpToTheBudgetAndGiveItBack) {
  ByteBudget budget(100);
  ByteBudget::Share first(budget);
  EXPECT_TRUE(first.grow(60));
  {
    ByteBudget::Share second(budget);
    EXPECT_TRUE(second.grow(30));
    EXPECT_FALSE(second.grow(11));
    EXPECT_EQ(budget.used(), 90U);
    EXPECT_TRUE(second.grow(10));
    EXPECT_FALSE(first.grow(1));
  }
  EXPECT_EQ(budget.used(), 60U);
  EXPECT_TRUE(first.grow(40));
}

TEST(ByteBudget, NothingIsLostBetweenThreads) {
  ByteBudget budget(1000);
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i) {
      threads.emplace_back([&] {
        for (int round = 0; round < 2000; ++round) {
          ByteBudget::Share share(budget);
          while (share.grow(97)) EXPECT_LE(budget.used(), 1000U + 8 * 97);  // a refused one shows for a moment
        }
      });
    }
  }
  EXPECT_EQ(budget.used(), 0U);
}

}  // namespace
}  // namespace spherematch
