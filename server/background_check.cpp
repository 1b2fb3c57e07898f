#include "server/background_check.h"

#include <exception>

namespace spherematch {

BackgroundCheck::BackgroundCheck(Question question, Limits limits)
    : question_(std::move(question)), limits_(limits), thread_([this] { work_loop(); }) {}

BackgroundCheck::~BackgroundCheck() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
}

BackgroundCheck::Answer BackgroundCheck::answer() {
  std::unique_lock lock(mutex_);
  const auto fresh = [this] { return answered_ && Clock::now() - *answered_ < limits_.max_age; };
  if (fresh()) return answer_;
  if (!asked_) {
    wanted_ = true;
    changed_.notify_all();
  }
  if (changed_.wait_for(lock, limits_.patience, fresh)) return answer_;
  if (answered_ && (!asked_ || Clock::now() - *asked_ < limits_.too_long)) return answer_;
  return {.good = false, .detail = "no answer yet; it is taking too long"};
}

void BackgroundCheck::work_loop() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || wanted_; });
    if (stopping_) return;
    wanted_ = false;
    asked_ = Clock::now();
    lock.unlock();
    Answer answer = ask();
    lock.lock();
    answer_ = std::move(answer);
    answered_ = Clock::now();
    asked_.reset();
    changed_.notify_all();
  }
}

BackgroundCheck::Answer BackgroundCheck::ask() const {
  try {
    return {.good = true, .detail = question_()};
  } catch (const std::exception& error) {
    return {.good = false, .detail = error.what()};
  }
}

}  // namespace spherematch
