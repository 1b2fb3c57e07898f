#include "server/job_runner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <latch>
#include <set>

namespace spherematch {
namespace {

using namespace std::chrono_literals;
using Clock = JobRunner::Clock;
using Outcome = JobRunner::Outcome;
using Submitted = JobRunner::Submitted;

/// Blocks every job until open() or until it is asked to stop.
class Door {
 public:
  Outcome pass(const Progress& progress) {
    ++arrived_;
    while (!open_ && !progress.stop.stop_requested()) std::this_thread::sleep_for(1ms);
    if (!open_) ++stopped_;
    return Outcome::done;
  }
  void open() { open_ = true; }
  void wait_for_arrivals(int count) const {
    while (arrived_ < count) std::this_thread::sleep_for(1ms);
  }
  [[nodiscard]] int arrived() const { return arrived_; }
  [[nodiscard]] int stopped() const { return stopped_; }

 private:
  std::atomic<bool> open_ = false;
  std::atomic<int> arrived_ = 0;
  std::atomic<int> stopped_ = 0;
};

TEST(JobRunner, RunsEachJobOnceAndWakesWaiters) {
  std::mutex mutex;
  std::multiset<std::string> ran;
  JobRunner runner(
      [&](const std::string& key, const Progress&) {
        const std::lock_guard lock(mutex);
        ran.insert(key);
        return Outcome::done;
      },
      3, 100);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(runner.submit(std::to_string(i)), Submitted::queued);
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(runner.wait(std::to_string(i), Clock::now() + 10s));
  EXPECT_EQ(ran.size(), 50U);
  EXPECT_EQ(std::set(ran.begin(), ran.end()).size(), 50U);
  EXPECT_EQ(runner.status("7"), std::nullopt);
}

TEST(JobRunner, OneActiveJobPerKey) {
  Door door;
  JobRunner runner([&](const std::string&, const Progress& progress) { return door.pass(progress); }, 1, 10);
  EXPECT_EQ(runner.submit("a"), Submitted::queued);
  door.wait_for_arrivals(1);
  EXPECT_EQ(runner.submit("a"), Submitted::already_active);
  EXPECT_FALSE(runner.wait("a", Clock::now() + 20ms));
  door.open();
  EXPECT_TRUE(runner.wait("a", Clock::now() + 10s));
  EXPECT_EQ(runner.submit("a"), Submitted::queued);
  EXPECT_TRUE(runner.wait("a", Clock::now() + 10s));
  EXPECT_EQ(door.arrived(), 2);
}

TEST(JobRunner, TheQueueIsBounded) {
  Door door;
  JobRunner runner([&](const std::string&, const Progress& progress) { return door.pass(progress); }, 1, 2);
  EXPECT_EQ(runner.submit("running"), Submitted::queued);
  door.wait_for_arrivals(1);
  EXPECT_EQ(runner.submit("a"), Submitted::queued);
  EXPECT_FALSE(runner.full());
  EXPECT_EQ(runner.submit("b"), Submitted::queued);
  EXPECT_TRUE(runner.full());
  EXPECT_EQ(runner.submit("c"), Submitted::full);
  EXPECT_EQ(runner.submit("c", /*beyond_limit=*/true), Submitted::queued);
  EXPECT_EQ(runner.counts().queued, 3U);
  EXPECT_EQ(runner.counts().running, 1U);
  door.open();
  EXPECT_TRUE(runner.wait("c", Clock::now() + 10s));
}

TEST(JobRunner, SilenceIsSinceTheLastReport) {
  std::atomic<bool> talks = false;
  std::atomic<bool> end = false;
  JobRunner runner(
      [&](const std::string&, const Progress& progress) {
        while (!end) {
          if (talks) progress.report("stage", 0.5);
          std::this_thread::sleep_for(1ms);
        }
        return JobRunner::Outcome::done;
      },
      1, 10);
  EXPECT_EQ(runner.counts().silence, JobRunner::Clock::duration{});
  runner.submit("a");
  while (runner.counts().silence < 50ms) std::this_thread::sleep_for(1ms);
  talks = true;
  while (runner.counts().silence >= 50ms) std::this_thread::sleep_for(1ms);
  runner.submit("waits behind it");
  talks = false;
  while (runner.counts().silence < 50ms) std::this_thread::sleep_for(1ms);
  end = true;
  EXPECT_TRUE(runner.wait("waits behind it", Clock::now() + 10s));
  while (runner.counts().running != 0) std::this_thread::sleep_for(1ms);
  EXPECT_EQ(runner.counts().silence, JobRunner::Clock::duration{});
}

TEST(JobRunner, ProgressIsVisibleAndNeverFalls) {
  Door door;
  JobRunner runner(
      [&](const std::string&, const Progress& progress) {
        progress.report("first", 0.5);
        progress.report("second", 0.25);
        progress.report("second", std::nan(""));
        return door.pass(progress);
      },
      1, 10);
  runner.submit("a");
  door.wait_for_arrivals(1);
  const auto status = runner.status("a");
  ASSERT_TRUE(status.has_value());
  EXPECT_TRUE(status->running);
  EXPECT_EQ(status->stage, "second");
  EXPECT_EQ(status->progress, 0.5);
  door.open();
  EXPECT_TRUE(runner.wait("a", Clock::now() + 10s));
}

TEST(JobRunner, CancellingARunningJobFreesItsKeyAtOnce) {
  Door door;
  JobRunner runner([&](const std::string&, const Progress& progress) { return door.pass(progress); }, 1, 10);
  runner.submit("a");
  door.wait_for_arrivals(1);
  runner.cancel("a");
  EXPECT_TRUE(runner.wait("a", Clock::now()));
  EXPECT_EQ(runner.submit("a"), Submitted::queued);
  door.wait_for_arrivals(2);
  EXPECT_EQ(door.stopped(), 1);
  // The first job has ended by now, and its end must not have taken the second job's entry away.
  EXPECT_TRUE(runner.status("a").has_value());
  door.open();
  EXPECT_TRUE(runner.wait("a", Clock::now() + 10s));
}

TEST(JobRunner, ACancelledQueuedJobNeverRuns) {
  Door door;
  JobRunner runner([&](const std::string&, const Progress& progress) { return door.pass(progress); }, 1, 10);
  runner.submit("running");
  door.wait_for_arrivals(1);
  runner.submit("a");
  runner.cancel("a");
  runner.cancel("unknown");
  EXPECT_EQ(runner.counts().queued, 0U);
  door.open();
  EXPECT_TRUE(runner.wait("running", Clock::now() + 10s));
  EXPECT_EQ(door.arrived(), 1);
}

TEST(JobRunner, ARepeatedJobGoesBehindTheOthersAndStaysStarted) {
  Door door;
  std::vector<std::string> order;  // by the one worker
  std::vector<JobStatus> seen;     // of "a", whenever something runs
  const JobRunner* self = nullptr;
  JobRunner runner(
      [&](const std::string& key, const Progress& progress) {
        door.pass(progress);
        order.push_back(key);
        progress.report("stage", order.size() == 1 ? 0.75 : 0.25);
        seen.push_back(self->status("a").value_or(JobStatus{}));
        return key == "a" && std::count(order.begin(), order.end(), key) < 3 ? Outcome::again : Outcome::done;
      },
      1, 10);
  self = &runner;
  runner.submit("a");
  door.wait_for_arrivals(1);
  runner.submit("b");
  runner.submit("c");
  door.open();
  EXPECT_TRUE(runner.wait("c", Clock::now() + 10s));
  EXPECT_TRUE(runner.wait("a", Clock::now() + 10s));
  EXPECT_EQ(order, (std::vector<std::string>{"a", "b", "c", "a", "a"}));
  for (const JobStatus& status : seen) {
    EXPECT_TRUE(status.running);
    EXPECT_EQ(status.progress, 0.75);
  }
}

TEST(JobRunner, ACancelledJobIsNotRepeated) {
  std::atomic<int> runs = 0;
  JobRunner runner(
      [&](const std::string& key, const Progress& progress) {
        if (key == "a") ++runs;
        while (key == "a" && !progress.stop.stop_requested()) std::this_thread::sleep_for(1ms);
        return key == "a" ? Outcome::again : Outcome::done;
      },
      1, 10);
  runner.submit("a");
  while (runs < 1) std::this_thread::yield();
  runner.cancel("a");
  runner.submit("b");
  EXPECT_TRUE(runner.wait("b", Clock::now() + 10s));
  EXPECT_EQ(runs, 1);
  EXPECT_EQ(runner.status("a"), std::nullopt);
}

TEST(JobRunner, StopCancelsJobsAndWakesWaiters) {
  Door door;
  JobRunner runner([&](const std::string&, const Progress& progress) { return door.pass(progress); }, 2, 10);
  for (const char* key : {"a", "b", "c"}) runner.submit(key);
  door.wait_for_arrivals(2);
  bool finished = true;
  std::latch started(1);
  std::jthread waiter([&] {
    started.count_down();
    finished = runner.wait("c", Clock::now() + 60s);
  });
  started.wait();
  const auto start = Clock::now();
  runner.stop();
  waiter.join();
  EXPECT_LT(Clock::now() - start, 10s);
  EXPECT_FALSE(finished);
  EXPECT_EQ(door.stopped(), 2);
  EXPECT_EQ(door.arrived(), 2);
  EXPECT_EQ(runner.submit("d"), Submitted::stopped);
}

}  // namespace
}  // namespace spherematch
