#include "server/job_runner.h"

#include <algorithm>

namespace spherematch {

JobRunner::JobRunner(Work work, std::size_t workers, std::size_t max_queued) : work_(std::move(work)), max_queued_(max_queued) {
  for (std::size_t i = 0; i < workers; ++i) workers_.emplace_back([this] { work_loop(); });
}

JobRunner::~JobRunner() { stop(); }

JobRunner::Submitted JobRunner::submit(const std::string& key, bool beyond_limit) {
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) return Submitted::stopped;
    if (active_.contains(key)) return Submitted::already_active;
    if (!beyond_limit && queue_.size() >= max_queued_) return Submitted::full;
    auto job = std::make_shared<Job>();
    job->key = key;
    if (queue_.empty()) queue_moved_ = Clock::now();
    active_.emplace(key, job);
    queue_.push_back(std::move(job));
  }
  queued_.notify_one();
  return Submitted::queued;
}

bool JobRunner::full() const {
  const std::lock_guard lock(mutex_);
  return queue_.size() >= max_queued_;
}

std::optional<JobStatus> JobRunner::status(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  const auto found = active_.find(key);
  if (found == active_.end()) return std::nullopt;
  JobStatus status = found->second->status;
  const auto place = std::find(queue_.begin(), queue_.end(), found->second);
  if (place != queue_.end()) status.position = static_cast<std::size_t>(place - queue_.begin());
  return status;
}

bool JobRunner::wait(const std::string& key, Clock::time_point deadline) const {
  std::unique_lock lock(mutex_);
  finished_.wait_until(lock, deadline, [&] { return stopping_ || !active_.contains(key); });
  return !active_.contains(key);
}

void JobRunner::cancel(const std::string& key) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = active_.find(key);
    if (found == active_.end()) return;
    found->second->stop.request_stop();
    std::erase(queue_, found->second);
    active_.erase(found);
  }
  finished_.notify_all();
}

void JobRunner::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    queue_.clear();
    for (const JobPointer& job : running_) job->stop.request_stop();
  }
  queued_.notify_all();
  finished_.notify_all();
  for (std::jthread& worker : workers_) {
    if (worker.joinable()) worker.join();
  }
}

JobRunner::Counts JobRunner::counts() const {
  const std::lock_guard lock(mutex_);
  Counts counts{queue_.size(), running_.size(), {}};
  const auto now = Clock::now();
  for (const JobPointer& job : running_) counts.silence = std::max(counts.silence, now - job->heard_of);
  // With every worker busy the queue may stand for as long as its jobs take; then it is they that have to be heard of.
  if (!queue_.empty() && running_.size() < workers_.size()) counts.silence = std::max(counts.silence, now - queue_moved_);
  return counts;
}

void JobRunner::work_loop() {
  while (true) {
    JobPointer job;
    {
      std::unique_lock lock(mutex_);
      queued_.wait(lock, [this] { return stopping_ || !queue_.empty(); });
      if (stopping_) return;
      job = queue_.front();
      queue_.pop_front();
      job->status.running = true;
      job->heard_of = queue_moved_ = Clock::now();
      running_.push_back(job);
    }
    finish(job, run(job));
  }
}

JobRunner::Outcome JobRunner::run(const JobPointer& job) {
  const Progress progress{.report =
                              [this, job](std::string_view stage, double fraction) {
                                const std::lock_guard lock(mutex_);
                                job->heard_of = Clock::now();
                                job->status.stage = stage;
                                // Stages may be reported out of order by several threads; a listener must never see a step back.
                                if (fraction > job->status.progress) job->status.progress = std::min(fraction, 1.0);
                              },
                          .stop = job->stop.get_token()};
  return work_(job->key, progress);
}

void JobRunner::finish(const JobPointer& job, Outcome outcome) {
  {
    const std::lock_guard lock(mutex_);
    std::erase(running_, job);
    queue_moved_ = Clock::now();  // from now on this worker has to take the next one
    // After cancel() the key may already stand for a newer job.
    const auto found = active_.find(job->key);
    const bool active = found != active_.end() && found->second == job;
    if (active && outcome == Outcome::again && !stopping_) {
      queue_.push_back(job);
    } else if (active) {
      active_.erase(found);
    }
  }
  queued_.notify_one();
  finished_.notify_all();
}

}  // namespace spherematch
