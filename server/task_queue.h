// The HTTP library's connections on a fixed number of threads with a bounded queue in front.
#pragma once

#include <httplib.h>

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace spherematch {

/// A task that finds the queue full runs at once on the thread that brings it; HttpServer sheds the connection there.
class BoundedTaskQueue final : public httplib::TaskQueue {
 public:
  BoundedTaskQueue(std::size_t threads, std::size_t max_queued);

  void enqueue(std::function<void()> task) override;
  /// Runs what is queued, then returns.
  void shutdown() override;

 private:
  void work_loop();

  const std::size_t max_queued_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  bool stopping_ = false;
  std::vector<std::jthread> threads_;
};

}  // namespace spherematch
