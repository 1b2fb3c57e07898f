#include "server/gate.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <thread>
#include <vector>

#include "server/problem.h"

namespace spherematch {
namespace {

api::Code code_of_refusal(Gate& gate) {
  try {
    const Gate::Permit permit = gate.enter();
  } catch (const ProblemError& error) {
    return error.problem().code;
  }
  ADD_FAILURE() << "was let in";
  return api::Code::internal;
}

void wait_until_waiting(const Gate& gate, std::size_t count) {
  while (gate.counts().waiting != count) std::this_thread::yield();
}

TEST(Gate, KnowsHowLongTheFirstHasBeenInside) {
  Gate gate("things", 2, 0);
  EXPECT_EQ(gate.counts().longest, Gate::Clock::duration{});
  std::optional<Gate::Permit> first(gate.enter());
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  const Gate::Permit second = gate.enter();
  EXPECT_GE(gate.counts().longest, std::chrono::milliseconds(30));
  const auto since_second = Gate::Clock::now();
  first.reset();
  EXPECT_LT(gate.counts().longest, Gate::Clock::now() - since_second + std::chrono::milliseconds(25));
}

TEST(Gate, NeverLetsInMoreThanItsSlots) {
  Gate gate("things", 3, 100);
  std::atomic<int> inside = 0;
  std::atomic<int> most = 0;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 20; ++i) {
      threads.emplace_back([&] {
        const Gate::Permit permit = gate.enter();
        const int now = ++inside;
        int seen = most;
        while (seen < now && !most.compare_exchange_weak(seen, now)) {
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        --inside;
      });
    }
  }
  EXPECT_EQ(most, 3);
  EXPECT_EQ(gate.counts().inside, 0U);
  EXPECT_EQ(gate.counts().waiting, 0U);
}

TEST(Gate, TurnsAwayWhoFindsTheQueueFull) {
  Gate gate("things", 1, 1);
  std::optional<Gate::Permit> first(gate.enter());
  std::jthread second([&] { const Gate::Permit permit = gate.enter(); });
  wait_until_waiting(gate, 1);
  EXPECT_EQ(code_of_refusal(gate), api::Code::overloaded);
  EXPECT_THROW(gate.require_room(), ProblemError);
  first.reset();
  second.join();
  EXPECT_NO_THROW(gate.require_room());
  EXPECT_NO_THROW((void)gate.enter());
}

TEST(Gate, ClosingTurnsAwayWhoWaitsAndWhoComes) {
  Gate gate("things", 1, 1);
  const Gate::Permit first = gate.enter();
  api::Code waiter = api::Code::internal;
  std::jthread second([&] { waiter = code_of_refusal(gate); });
  wait_until_waiting(gate, 1);
  gate.close();
  second.join();
  EXPECT_EQ(waiter, api::Code::draining);
  EXPECT_EQ(code_of_refusal(gate), api::Code::draining);
}

TEST(Gate, AMovedPermitFreesItsSlotOnce) {
  Gate gate("things", 1, 0);
  {
    Gate::Permit first = gate.enter();
    const Gate::Permit second = std::move(first);
    EXPECT_EQ(gate.counts().inside, 1U);
  }
  EXPECT_EQ(gate.counts().inside, 0U);
}

}  // namespace
}  // namespace spherematch
