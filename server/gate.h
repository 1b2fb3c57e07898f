// Bounds how many threads do something heavy at once, and how many wait for it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <set>
#include <string>

namespace spherematch {

/// Thread-safe.
class Gate {
 public:
  using Clock = std::chrono::steady_clock;

  /// `what` names the work in the message to those who are turned away.
  Gate(std::string what, std::size_t slots, std::size_t waiting) : what_(std::move(what)), slots_(slots), max_waiting_(waiting) {}
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;

  /// Holds one slot until destroyed; must not outlive the gate.
  class Permit {
   public:
    Permit(Gate* gate, Clock::time_point entered) : gate_(gate), entered_(entered) {}
    Permit(Permit&& other) noexcept : gate_(other.gate_), entered_(other.entered_) { other.gate_ = nullptr; }
    Permit& operator=(Permit&&) = delete;
    Permit(const Permit&) = delete;
    Permit& operator=(const Permit&) = delete;
    ~Permit();

   private:
    Gate* gate_;
    Clock::time_point entered_;
  };

  /// Waits for a slot. @throws ProblemError(overloaded) when too many wait already, ProblemError(draining) once closed
  [[nodiscard]] Permit enter();

  /// @throws ProblemError(overloaded) when enter() would do so now
  void require_room() const;

  /// Waits for a slot that nobody in enter() waits for, without a bound. @throws ProblemError(draining) once closed
  [[nodiscard]] Permit enter_behind();

  /// Turns away everybody who waits or comes later.
  void close();

  struct Counts {
    std::size_t inside = 0;
    std::size_t waiting = 0;
    Clock::duration longest{};  ///< how long the one who is inside longest has been there
  };
  [[nodiscard]] Counts counts() const;

 private:
  void leave(Clock::time_point entered);
  void require_room_locked() const;

  const std::string what_;
  const std::size_t slots_;
  const std::size_t max_waiting_;
  mutable std::mutex mutex_;
  std::condition_variable freed_;            ///< for those in enter()
  std::condition_variable freed_further_;    ///< for those behind them
  std::multiset<Clock::time_point> inside_;  ///< when each entered
  std::size_t waiting_ = 0;
  bool closed_ = false;
};

}  // namespace spherematch
