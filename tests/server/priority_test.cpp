#include "server/priority.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <thread>

namespace spherematch {
namespace {

int niceness() { return ::getpriority(PRIO_PROCESS, 0); }

TEST(Priority, IsOfTheThreadAndOfThoseThatItStarts) {
  const int before = niceness();
  const int wanted = std::max(before, preparation_niceness);
  int inner = -100;
  int innermost = -100;
  std::jthread([&] {
    be_nice(preparation_niceness);
    inner = niceness();
    std::jthread([&] { innermost = niceness(); }).join();
    be_nice(match_niceness);  // never back
    EXPECT_EQ(niceness(), inner);
  }).join();
  EXPECT_EQ(inner, wanted);
  EXPECT_EQ(innermost, wanted);
  EXPECT_EQ(niceness(), before);
}

}  // namespace
}  // namespace spherematch
