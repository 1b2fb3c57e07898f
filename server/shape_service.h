// Shapes from upload to prepared: the store, the preparation jobs and the cache of decoded shapes in one place.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "api/types.h"
#include "server/engine_port.h"
#include "server/job_runner.h"
#include "server/lru_cache.h"
#include "storage/shape_store.h"

namespace spherematch {

struct ShapeServiceSettings {
  std::size_t workers = 1;
  std::size_t max_queued = 1000;
  std::size_t max_long_polls = 24;  ///< further waiters are answered at once
  std::size_t cache_bytes = std::size_t{256} << 20;
  std::chrono::milliseconds pause_after_loss{1000};  ///< of a worker whose preparation was lost: what it lacked may come back
  ReadLimits read_limits;
  /// Called for every stage of a finished preparation, from any worker.
  std::function<void(std::string_view stage, double seconds)> on_stage{};
};

/// Thread-safe. Errors are thrown as ProblemError, EngineError or StorageError.
class ShapeService {
 public:
  using Clock = JobRunner::Clock;

  /// Store and engine must outlive this. Shapes that the store holds unfinished are queued at once.
  ShapeService(ShapeStore& store, const EnginePort& engine, const ShapeServiceSettings& settings);

  struct Posted {
    std::string id;
    bool known = false;  ///< nothing new is computed for this upload
  };
  /// Reads and checks the mesh, stores it and queues its preparation. Known bytes are neither read nor stored again; one that
  /// failed, or that an older engine prepared, is queued again; its labels stay. `file_name` may help to recognise the format.
  [[nodiscard]] Posted post(std::span<const std::byte> bytes, ShapeLabels labels, std::string_view file_name, const ReadOptions& options);

  /// Waits until no preparation of the shape is under way here; false when that did not happen in time. Beyond the bound of
  /// long polls it does not wait.
  bool wait_until_finished(const std::string& id, Clock::time_point deadline);

  /// @throws ProblemError(not_found)
  [[nodiscard]] api::Shape get(const std::string& id) const;
  [[nodiscard]] api::ShapePage list(std::size_t limit, const std::optional<std::string>& cursor, const ShapeFilter& filter = {}) const;
  /// The shape after the change. `accept` is asked about the shape as it is, and about no other before the change is made.
  /// @throws ProblemError(not_found), ProblemError(precondition_failed) when `accept` says no
  api::Shape change(const std::string& id, const ShapeChange& change, const std::function<bool(const api::Shape&)>& accept);
  /// Cancels the preparation and removes the shape with everything derived from it. @throws ProblemError(not_found)
  void remove(const std::string& id);

  /// @throws ProblemError(not_found)
  void require_known(const std::string& id) const;
  /// Also where the store cannot tell.
  [[nodiscard]] bool knows(const std::string& id) const;
  struct Usable {
    bool ready = false;         ///< for this engine, so that require_ready() would return at once
    std::int32_t vertices = 0;  ///< of the upload
  };
  /// @throws ProblemError(not_found), ProblemError(shape_failed)
  Usable require_usable(const std::string& id) const;
  /// Waits until the shape is ready for this engine, queueing its preparation where needed.
  /// @throws ProblemError(not_found, shape_failed, shape_not_ready, overloaded, draining)
  void require_ready(const std::string& id, Clock::time_point deadline);
  /// The decoded shape. What matches read of it stays in memory, the eigenbasis does not.
  /// @throws ProblemError(shape_not_ready) when it is not ready (any more)
  [[nodiscard]] ShapePointer load(const std::string& id, PreparedParts parts = PreparedParts::without_eigenbasis);
  struct StoredUpload {
    std::vector<std::byte> bytes;
    std::string format;  ///< what it was recognised as, "off" and the like
  };
  /// The upload as it came. @throws ProblemError(not_found)
  [[nodiscard]] StoredUpload load_upload(const std::string& id) const;
  /// The uploaded mesh, read again from the stored upload: its bytes and a small multiple of them in memory. @throws
  /// ProblemError(not_found)
  [[nodiscard]] PolygonMesh load_mesh(const std::string& id) const;

  /// The preparation under way, if any.
  [[nodiscard]] std::optional<JobStatus> preparation(const std::string& id) const { return jobs_.status(id); }
  /// The shape becomes failed. @throws ProblemError(not_found), ProblemError(job_finished) when no preparation is under way
  void cancel_preparation(const std::string& id);

  [[nodiscard]] JobRunner::Counts job_counts() const { return jobs_.counts(); }
  [[nodiscard]] std::size_t cache_bytes() const { return cache_.bytes(); }

  /// Cancels the jobs and wakes all waiters; returns when the workers are idle.
  void stop();

 private:
  [[nodiscard]] ShapeRecord record_of(const std::string& id) const;
  JobRunner::Outcome prepare(const std::string& id, const Progress& progress);
  void compute(const std::string& id, const Progress& progress);
  /// `again` where the reason may be gone at the next attempt.
  JobRunner::Outcome record_failure(const std::string& id, const Progress& progress, const std::exception_ptr& exception);
  /// @throws ProblemError(overloaded) To be asked before a shape is queued in the store, so that none is queued there alone.
  void require_room() const;
  void submit(const std::string& id);
  /// False where it has to be prepared first, also because an older engine did. @throws ProblemError(not_found, shape_failed)
  bool is_ready(const std::string& id);
  Posted post_known(const ShapeRecord& record);

  ShapeStore& store_;
  const EnginePort& engine_;
  const ShapeServiceSettings settings_;
  LruCache<PreprocessedShape> cache_;
  std::atomic<std::size_t> long_polls_ = 0;
  JobRunner jobs_;  ///< last: its workers use everything above
};

}  // namespace spherematch
