#include "server/deferred_saves.h"

#include <utility>

namespace spherematch {

void DeferredSaves::add(const std::string& key, MatchPointer result, Save save) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() < max_waiting_) {
      waiting_.push_back({key, std::move(result), std::move(save)});
      added_.notify_one();
      return;
    }
  }
  save();
}

MatchPointer DeferredSaves::find(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  for (const Waiting& waiting : waiting_) {
    if (waiting.key == key) return waiting.result;
  }
  return nullptr;
}

void DeferredSaves::drop_if(const std::function<bool(std::string_view key)>& unwanted) {
  const std::lock_guard lock(mutex_);
  // They keep their places: work() counts on the first to stay.
  for (Waiting& waiting : waiting_) {
    if (unwanted(waiting.key)) waiting = {};
  }
}

void DeferredSaves::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (true) {
    added_.wait(lock, stop, [this] { return !waiting_.empty(); });
    if (waiting_.empty()) return;  // stopped, and nothing is left
    const Save save = waiting_.front().save;
    lock.unlock();
    if (save) save();
    lock.lock();
    waiting_.pop_front();  // only now: until it is in the store, find() has it
  }
}

}  // namespace spherematch
