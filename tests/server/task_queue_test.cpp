#include "server/task_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <optional>

namespace spherematch {
namespace {

TEST(BoundedTaskQueue, ItsEndRunsWhatIsQueued) {
  std::atomic<int> ran = 0;
  std::optional<BoundedTaskQueue> queue(std::in_place, 2, 100);
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(queue->enqueue([&] { ++ran; }));
  queue.reset();
  EXPECT_EQ(ran, 50);
}

TEST(BoundedTaskQueue, BeyondItsBoundTasksAreDropped) {
  std::optional<BoundedTaskQueue> queue(std::in_place, 1, 2);
  std::latch started(1);
  std::latch release(1);
  EXPECT_TRUE(queue->enqueue([&] {
    started.count_down();
    release.wait();
  }));
  started.wait();
  std::atomic<int> ran = 0;
  int taken = 0;
  for (int i = 0; i < 5; ++i) taken += queue->enqueue([&] { ++ran; }) ? 1 : 0;
  EXPECT_EQ(taken, 2);
  EXPECT_EQ(ran, 0);
  release.count_down();
  queue.reset();
  EXPECT_EQ(ran, 2);
}

}  // namespace
}  // namespace spherematch
