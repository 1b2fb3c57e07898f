// Writes to the store that nobody has to wait for.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include "engine/data/correspondence.h"

namespace spherematch {

using MatchPointer = std::shared_ptr<const MatchResult>;

/// Saves results of matches one after the other on a thread of its own. Thread-safe.
class DeferredSaves {
 public:
  using Save = std::function<void()>;  ///< must not throw

  explicit DeferredSaves(std::size_t max_waiting)
      : max_waiting_(max_waiting), thread_([this](const std::stop_token& stop) { work(stop); }) {}
  ~DeferredSaves() = default;  ///< returns when everything is saved
  DeferredSaves(const DeferredSaves&) = delete;
  DeferredSaves& operator=(const DeferredSaves&) = delete;

  /// Calls `save` soon; where `max_waiting` wait already, at once and on the caller's thread, so that they do not pile up.
  void add(const std::string& key, MatchPointer result, Save save);

  /// The result that add() got under this key, while it is not saved; else null.
  [[nodiscard]] MatchPointer find(const std::string& key) const;

  /// What waits under such keys is neither found nor saved any more; what is being saved at this moment is not found. Does not wait.
  void drop_if(const std::function<bool(std::string_view key)>& unwanted);

 private:
  struct Waiting {
    std::string key;  ///< empty: dropped
    MatchPointer result;
    Save save;
  };

  void work(const std::stop_token& stop);

  const std::size_t max_waiting_;
  mutable std::mutex mutex_;
  std::condition_variable_any added_;
  std::deque<Waiting> waiting_;  ///< the first is being saved
  std::jthread thread_;          ///< last, so that it ends while the others are there
};

}  // namespace spherematch
