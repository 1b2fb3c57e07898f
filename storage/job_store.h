// Keeps jobs that match many pairs, and lists them together with the preparations of shapes.
//
// Thread-safe, and safe beside other processes on the same file, like storage/shape_store.h, whose errors it shares. Every change is on
// the disk when the function returns, so that a job goes on after a restart where it was.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "storage/shape_store.h"

namespace spherematch {

enum class JobKind { preprocess, match };
enum class JobState { queued, processing, succeeded, failed, cancelled };

/// "preprocess", "match".
[[nodiscard]] std::string_view to_string(JobKind kind);
/// "queued", "processing", "succeeded", "failed", "cancelled".
[[nodiscard]] std::string_view to_string(JobState state);

struct JobRecord {
  std::string id;  ///< of a preparation: "p" and the shape's id
  JobKind kind = JobKind::match;
  JobState state = JobState::queued;  ///< of a match job: succeeded as soon as every pair has its line, also where a pair failed
  std::string created_at;             ///< RFC 3339, UTC
  std::string started_at;             ///< empty before
  std::string finished_at;            ///< empty before
  std::string shape;                  ///< of a preparation: the shape
  std::string error_code;             ///< of a failed preparation
  std::string error_detail;
  std::string options;  ///< of a match job: what create() got
  std::int32_t pairs = 0;
  std::int32_t finished_pairs = 0;  ///< with those that failed
  std::int32_t failed_pairs = 0;
};

struct JobPair {
  std::int32_t position = 0;  ///< in the request, from 0
  std::string source;         ///< shape ids
  std::string target;
  std::string error_code;  ///< once failed, else empty
  std::string error_detail;
};

struct JobFilter {
  std::optional<JobKind> kind;
  std::optional<JobState> state;
};

struct JobPage {
  std::vector<JobRecord> jobs;             ///< newest first
  std::optional<std::string> next_cursor;  ///< engaged when older jobs remain
};

class JobStore {
 public:
  /// On the file of `shapes`.
  explicit JobStore(const ShapeStore& shapes) : pool_(shapes.pool()) {}

  /// Stores a match job. Older finished jobs beyond `keep_finished` are dropped.
  void create(std::string_view id, std::string_view options, const std::vector<std::pair<std::string, std::string>>& pairs,
              std::int64_t keep_finished);

  [[nodiscard]] std::optional<JobRecord> find(std::string_view id) const;

  /// @throws StorageError(invalid_cursor)
  [[nodiscard]] JobPage list(std::size_t limit, const std::optional<std::string>& cursor, const JobFilter& filter) const;

  /// Match jobs that are queued or processing, oldest first.
  [[nodiscard]] std::vector<std::string> unfinished() const;
  /// Pairs without a line, in the order of the request.
  [[nodiscard]] std::vector<JobPair> open_pairs(std::string_view id) const;

  void mark_started(std::string_view id);
  /// Gives the pair its line, the next of the job; with an error where `error_code` is not empty. The last pair ends the job. False, with
  /// nothing changed, when the pair has one already or the job is no longer active.
  bool finish_pair(std::string_view id, std::int32_t position, std::string_view error_code = {}, std::string_view error_detail = {});
  /// False when the job is not active.
  bool cancel(std::string_view id);
  /// Forgets a match job that is not active; false where there is none.
  bool remove(std::string_view id);

  /// The finished pairs from line `after` + 1 on, in the order in which they finished, at most `limit`.
  [[nodiscard]] std::vector<JobPair> lines(std::string_view id, std::int32_t after, std::int32_t limit) const;

 private:
  std::shared_ptr<ConnectionPool> pool_;
};

}  // namespace spherematch
