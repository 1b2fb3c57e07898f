#include "server/gate.h"

#include "server/problem.h"

namespace spherematch {

Gate::Permit::~Permit() {
  if (gate_ != nullptr) gate_->leave(entered_);
}

Gate::Permit Gate::enter() {
  std::unique_lock lock(mutex_);
  if (!closed_ && inside_.size() == slots_) {
    require_room_locked();
    ++waiting_;
    freed_.wait(lock, [this] { return closed_ || inside_.size() < slots_; });
    --waiting_;
  }
  if (closed_) throw ProblemError(api::Code::draining, "the server is stopping");
  const auto now = Clock::now();
  inside_.insert(now);
  return {this, now};
}

void Gate::require_room() const {
  const std::lock_guard lock(mutex_);
  if (!closed_) require_room_locked();
}

void Gate::require_room_locked() const {
  if (inside_.size() == slots_ && waiting_ == max_waiting_) {
    throw ProblemError(api::Code::overloaded, "too many " + what_ + " at once; try again");
  }
}

Gate::Permit Gate::enter_behind() {
  std::unique_lock lock(mutex_);
  freed_further_.wait(lock, [this] { return closed_ || (inside_.size() < slots_ && waiting_ == 0); });
  if (closed_) throw ProblemError(api::Code::draining, "the server is stopping");
  const auto now = Clock::now();
  inside_.insert(now);
  return {this, now};
}

void Gate::leave(Clock::time_point entered) {
  bool awaited = false;
  {
    const std::lock_guard lock(mutex_);
    inside_.erase(inside_.find(entered));
    awaited = waiting_ > 0;
  }
  (awaited ? freed_ : freed_further_).notify_one();
}

void Gate::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  freed_.notify_all();
  freed_further_.notify_all();
}

Gate::Counts Gate::counts() const {
  const std::lock_guard lock(mutex_);
  return {inside_.size(), waiting_, inside_.empty() ? Clock::duration{} : Clock::now() - *inside_.begin()};
}

}  // namespace spherematch
