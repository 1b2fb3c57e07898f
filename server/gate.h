// Bounds how many threads do something heavy at once, and how many wait for it.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>

namespace spherematch {

/// Thread-safe.
class Gate {
 public:
  /// `what` names the work in the message to those who are turned away.
  Gate(std::string what, std::size_t slots, std::size_t waiting) : what_(std::move(what)), slots_(slots), max_waiting_(waiting) {}
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;

  /// Holds one slot until destroyed; must not outlive the gate.
  class Permit {
   public:
    explicit Permit(Gate* gate) : gate_(gate) {}
    Permit(Permit&& other) noexcept : gate_(other.gate_) { other.gate_ = nullptr; }
    Permit& operator=(Permit&&) = delete;
    Permit(const Permit&) = delete;
    Permit& operator=(const Permit&) = delete;
    ~Permit();

   private:
    Gate* gate_;
  };

  /// Waits for a slot. @throws ProblemError(overloaded) when too many wait already, ProblemError(draining) once closed
  [[nodiscard]] Permit enter();

  /// Waits for a slot that nobody in enter() waits for, without a bound. @throws ProblemError(draining) once closed
  [[nodiscard]] Permit enter_behind();

  /// Turns away everybody who waits or comes later.
  void close();

  struct Counts {
    std::size_t inside = 0;
    std::size_t waiting = 0;
  };
  [[nodiscard]] Counts counts() const;

 private:
  void leave();

  const std::string what_;
  const std::size_t slots_;
  const std::size_t max_waiting_;
  mutable std::mutex mutex_;
  std::condition_variable freed_;          ///< for those in enter()
  std::condition_variable freed_further_;  ///< for those behind them
  std::size_t inside_ = 0;
  std::size_t waiting_ = 0;
  bool closed_ = false;
};

}  // namespace spherematch
