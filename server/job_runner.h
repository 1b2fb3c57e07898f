// A bounded pool of workers for long jobs that are known by a key, report progress, and can be waited for and cancelled.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include "engine/data/progress.h"

namespace spherematch {

struct JobStatus {
  bool running = false;  ///< false until it is started for the first time
  std::string stage;
  double progress = 0;       ///< in [0, 1]; never falls
  std::size_t position = 0;  ///< how many jobs are in front of it in the queue; 0 when it is not queued
};

/// Thread-safe. Of one key at most one job is active (queued or running) at a time.
class JobRunner {
 public:
  enum class Outcome { done, again };
  /// Does the job. Must not throw. A job that was cancelled should return soon after `progress.stop` is requested. With `again`
  /// the same job is put at the end of the queue; meanwhile it counts as running to those who ask for its status.
  using Work = std::function<Outcome(const std::string& key, const Progress& progress)>;
  using Clock = std::chrono::steady_clock;

  JobRunner(Work work, std::size_t workers, std::size_t max_queued);
  ~JobRunner();  ///< stop()
  JobRunner(const JobRunner&) = delete;
  JobRunner& operator=(const JobRunner&) = delete;

  enum class Submitted { queued, already_active, full, stopped };
  /// `beyond_limit` is for jobs that were accepted earlier, as before a restart.
  Submitted submit(const std::string& key, bool beyond_limit = false);

  [[nodiscard]] bool full() const;

  /// Nothing when no job of this key is active.
  [[nodiscard]] std::optional<JobStatus> status(const std::string& key) const;

  /// Waits until no job of this key is active; false when that did not happen in time or the runner was stopped.
  [[nodiscard]] bool wait(const std::string& key, Clock::time_point deadline) const;

  /// Forgets the job at once; a running one is asked to stop and its further reports go nowhere.
  void cancel(const std::string& key);

  /// Asks every job to stop, wakes all waiters, and returns when the workers are idle. Queued jobs are dropped.
  void stop();

  struct Counts {
    std::size_t queued = 0;
    std::size_t running = 0;
    /// For how long nothing was heard of the job that has been silent longest: of a running one since its last report, of the queue
    /// since a job was last taken from it.
    Clock::duration silence{};
  };
  [[nodiscard]] Counts counts() const;

 private:
  struct Job {
    std::string key;
    JobStatus status;
    std::stop_source stop;
    Clock::time_point heard_of{};  ///< when it was queued, taken up, or reported last
  };
  using JobPointer = std::shared_ptr<Job>;

  void work_loop();
  Outcome run(const JobPointer& job);
  void finish(const JobPointer& job, Outcome outcome);

  const Work work_;
  const std::size_t max_queued_;
  mutable std::mutex mutex_;
  std::condition_variable queued_;            ///< a worker has something to do
  mutable std::condition_variable finished_;  ///< a job is no longer active
  std::deque<JobPointer> queue_;
  std::unordered_map<std::string, JobPointer> active_;
  std::vector<JobPointer> running_;  ///< includes cancelled ones that have not returned yet
  Clock::time_point queue_moved_{};  ///< when a job was last taken from it, came while it was empty, or could have been taken
  bool stopping_ = false;
  std::vector<std::jthread> workers_;
};

}  // namespace spherematch
