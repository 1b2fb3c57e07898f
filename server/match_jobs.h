// Jobs that match many pairs: kept in the store, worked off when nobody waits for a match, resumed after a restart.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "api/types.h"
#include "server/match_response.h"
#include "server/match_service.h"
#include "server/shape_service.h"
#include "storage/job_store.h"

namespace spherematch {

struct MatchJobsSettings {
  std::size_t workers = 1;
  std::size_t max_active = 100;                 ///< further ones get 503
  std::int64_t keep_finished = 1000;            ///< older ones are forgotten
  std::chrono::milliseconds retry_after{1000};  ///< of a pair whose shapes are not ready
};

/// What holds for all pairs of a job.
struct MatchJobOptions {
  MatchParameters parameters;
  MatchFields fields;
};

/// Thread-safe. Errors are thrown as ProblemError or StorageError.
class MatchJobs {
 public:
  using Clock = std::chrono::steady_clock;

  /// All must outlive this. Goes on with the jobs that the store holds unfinished.
  MatchJobs(JobStore& store, ShapeService& shapes, MatchService& matches, const MatchJobsSettings& settings);
  ~MatchJobs();  ///< stop()
  MatchJobs(const MatchJobs&) = delete;
  MatchJobs& operator=(const MatchJobs&) = delete;

  /// Stores the job and returns its id. @throws ProblemError(invalid_parameter, not_found, overloaded, draining)
  [[nodiscard]] std::string create(const api::MatchRequest& request);

  /// How many active jobs are in front of it.
  [[nodiscard]] std::int32_t position(std::string_view id) const;

  /// Waits until the job is no longer active; false when that did not happen in time.
  bool wait(std::string_view id, Clock::time_point deadline) const;
  /// Waits until more than `lines` pairs are finished or the job is no longer active; false when neither happened in time.
  bool wait_for_line(std::string_view id, std::int32_t lines, Clock::time_point deadline) const;

  /// The pairs under way are given up, but where somebody else waits for the same match. False when the job is not active.
  bool cancel(std::string_view id);

  /// The result of a finished pair. One that has left the cache meanwhile is computed again.
  [[nodiscard]] api::PairResult result_of(const JobPair& pair, const MatchJobOptions& options);
  [[nodiscard]] static MatchJobOptions options_of(std::string_view stored);

  /// Returns when the workers are idle. What is unfinished goes on with the next server.
  void stop();

  struct Counts {
    std::size_t queued = 0;
    std::size_t processing = 0;
  };
  [[nodiscard]] Counts counts() const;

 private:
  struct Active {
    std::string id;
    MatchJobOptions options;
    std::stop_source cancelled;
    std::deque<JobPair> open;  ///< not started
    std::int32_t running = 0;
    std::int32_t finished = 0;
    bool started = false;
    std::size_t put_off = 0;         ///< pairs in a row that could not be worked on
    Clock::time_point not_before{};  ///< set when that were all of them
  };
  using ActivePointer = std::shared_ptr<Active>;
  enum class Outcome { finished, later, stopped };

  void add(const std::string& id, std::string_view options, std::int32_t finished);
  void work_loop();
  [[nodiscard]] ActivePointer next_locked(Clock::time_point& wake) const;
  [[nodiscard]] Outcome run(const Active& job, const JobPair& pair);
  void settle(const ActivePointer& job, const JobPair& pair, Outcome outcome);
  [[nodiscard]] ActivePointer find_locked(std::string_view id) const;

  JobStore& store_;
  ShapeService& shapes_;
  MatchService& matches_;
  const MatchJobsSettings settings_;
  mutable std::mutex mutex_;
  std::condition_variable work_;             ///< there may be something to do
  mutable std::condition_variable changed_;  ///< a pair or a job has ended
  std::list<ActivePointer> active_;          ///< oldest first
  bool stopping_ = false;
  std::vector<std::jthread> workers_;
};

}  // namespace spherematch
