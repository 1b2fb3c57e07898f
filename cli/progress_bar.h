// A bar that redraws itself on a terminal, and nothing elsewhere.
#pragma once

#include <chrono>
#include <mutex>
#include <ostream>
#include <string>
#include <string_view>

namespace spherematch {

/// Thread-safe. Never moves back.
class ProgressBar {
 public:
  /// Draws to `out` where `enabled`, which is meant to be: `out` is a terminal.
  ProgressBar(std::ostream& out, bool enabled) : out_(out), enabled_(enabled) {}
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void report(std::string_view stage, double fraction);
  /// Wipes the line.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::ostream& out_;
  const bool enabled_;
  std::mutex mutex_;
  double fraction_ = 0;
  std::string stage_;
  Clock::time_point drawn_;
  bool visible_ = false;
};

}  // namespace spherematch
