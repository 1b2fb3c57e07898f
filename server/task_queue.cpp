#include "server/task_queue.h"

namespace spherematch {

BoundedTaskQueue::BoundedTaskQueue(std::size_t threads, std::size_t max_queued) : max_queued_(max_queued) {
  for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { work_loop(); });
}

void BoundedTaskQueue::enqueue(std::function<void()> task) {
  {
    std::unique_lock lock(mutex_);
    if (tasks_.size() >= max_queued_) {
      lock.unlock();
      task();
      return;
    }
    tasks_.push_back(std::move(task));
  }
  changed_.notify_one();
}

void BoundedTaskQueue::shutdown() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  threads_.clear();  // joins
}

void BoundedTaskQueue::work_loop() {
  while (true) {
    std::function<void()> task;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
      if (tasks_.empty()) return;
      task = std::move(tasks_.front());
      tasks_.pop_front();
    }
    task();
  }
}

}  // namespace spherematch
