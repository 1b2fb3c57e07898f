// Asks a question that may take long, or never be answered, without making those wait who want to know.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace spherematch {

/// Thread-safe. The question is asked on a thread of its own, only when somebody wants to know, and at most once in `max_age`.
class BackgroundCheck {
 public:
  using Clock = std::chrono::steady_clock;
  /// Returns a sentence of what is good. Throws std::exception with what is wrong.
  using Question = std::function<std::string()>;

  struct Limits {
    std::chrono::milliseconds max_age{1000};     ///< an answer younger than this is given again
    std::chrono::milliseconds patience{500};     ///< so long a caller waits for a new answer before it gets the old one
    std::chrono::milliseconds too_long{10'000};  ///< a question that takes longer than this counts as a bad answer
  };

  BackgroundCheck(Question question, Limits limits);
  ~BackgroundCheck();  ///< waits for the question that is being asked
  BackgroundCheck(const BackgroundCheck&) = delete;
  BackgroundCheck& operator=(const BackgroundCheck&) = delete;

  struct Answer {
    bool good = false;
    std::string detail;
  };
  [[nodiscard]] Answer answer();

 private:
  void work_loop();
  [[nodiscard]] Answer ask() const;

  const Question question_;
  const Limits limits_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool wanted_ = false;
  bool stopping_ = false;
  std::optional<Clock::time_point> asked_;     ///< engaged while the question is being asked
  std::optional<Clock::time_point> answered_;  ///< when the last answer came
  Answer answer_;
  std::jthread thread_;  ///< last: it uses everything above
};

}  // namespace spherematch
