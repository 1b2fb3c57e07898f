#include "server/task_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>

namespace spherematch {
namespace {

TEST(BoundedTaskQueue, ShutdownRunsWhatIsQueued) {
  std::atomic<int> ran = 0;
  BoundedTaskQueue queue(2, 100);
  for (int i = 0; i < 50; ++i) queue.enqueue([&] { ++ran; });
  queue.shutdown();
  EXPECT_EQ(ran, 50);
}

TEST(BoundedTaskQueue, BeyondItsBoundTasksRunWhereTheyComeFrom) {
  BoundedTaskQueue queue(1, 2);
  std::latch started(1);
  std::latch release(1);
  queue.enqueue([&] {
    started.count_down();
    release.wait();
  });
  started.wait();
  std::atomic<int> elsewhere = 0;
  std::atomic<int> here = 0;
  const auto self = std::this_thread::get_id();
  for (int i = 0; i < 5; ++i) queue.enqueue([&] { ++(std::this_thread::get_id() == self ? here : elsewhere); });
  EXPECT_EQ(here, 3);
  EXPECT_EQ(elsewhere, 0);
  release.count_down();
  queue.shutdown();
  EXPECT_EQ(here, 3);
  EXPECT_EQ(elsewhere, 2);
}

}  // namespace
}  // namespace spherematch
