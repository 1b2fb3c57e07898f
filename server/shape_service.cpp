#include "server/shape_service.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <set>

#include "engine/io/mesh_reader.h"
#include "server/event_log.h"
#include "server/memory_size.h"
#include "server/problem.h"
#include "server/shape_json.h"
#include "storage/content_id.h"
#include "storage/error.h"
#include "storage/upload_options.h"

namespace spherematch {

namespace {

ProblemError no_such_shape(const std::string& id) { return {api::Code::not_found, "there is no shape '" + id.substr(0, 64) + "'"}; }

ProblemError not_ready(const std::string& id) { return {api::Code::shape_not_ready, "shape " + id + " is still being prepared"}; }

ProblemError failed(const ShapeRecord& record) {
  return {api::Code::shape_failed, "shape " + record.id + " could not be prepared: " + record.error_detail};
}

/// Of a preparation that ends for reasons which may lie outside the shape: want of memory or space, a process that was killed.
constexpr int max_attempts = 3;

/// Ends early with a stop.
void pause(const std::stop_token& stop, std::chrono::milliseconds time) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any never;
  never.wait_for(lock, stop, time, [] { return false; });
}

ProblemError preparation_problem(const std::exception_ptr& exception) {
  try {
    std::rethrow_exception(exception);
  } catch (const PreparationLost& lost) {
    return {api::Code::internal, std::string("the preparation broke off each time: ") + lost.what()};
  } catch (...) {
    return problem_of(std::current_exception());
  }
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Logs each stage when it is first heard of, and passes every report on. Stages may run side by side.
class StageLog {
 public:
  StageLog(std::string id, Progress progress) : id_(std::move(id)), inner_(std::move(progress)) {}

  [[nodiscard]] Progress progress() {
    return {.report =
                [this](std::string_view stage, double fraction) {
                  inner_.report(stage, fraction);
                  const std::lock_guard lock(mutex_);
                  if (!seen_.emplace(stage).second) return;
                  log_info("stage_started", {{"shape", id_}, {"stage", stage}, {"seconds", seconds_since(started_)}});
                },
            .stop = inner_.stop};
  }

 private:
  const std::string id_;
  const Progress inner_;
  const std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::set<std::string, std::less<>> seen_;
};

}  // namespace

ShapeService::ShapeService(ShapeStore& store, const EnginePort& engine, const ShapeServiceSettings& settings)
    : store_(store),
      engine_(engine),
      settings_(settings),
      cache_(settings.cache_bytes),
      jobs_([this](const std::string& id, const Progress& progress) { return prepare(id, progress); }, settings.workers,
            settings.max_queued) {
  for (const std::string& id : store_.requeue_unfinished()) jobs_.submit(id, /*beyond_limit=*/true);
}

ShapeService::Posted ShapeService::post(std::span<const std::byte> bytes, ShapeLabels labels, std::string_view file_name,
                                        const ReadOptions& options) {
  const ContentId content = content_id(bytes, upload_options(options));
  if (const auto known = store_.find(content.id)) return post_known(*known);
  require_room();  // before the mesh is read and stored: a refused upload leaves nothing behind
  const Surface surface = engine_.read_surface(bytes, file_name, options, settings_.read_limits);
  labels.format = mesh_format_of(bytes, file_name);
  const InsertOutcome outcome = store_.insert(content, labels, bytes, surface);
  jobs_.submit(content.id, /*beyond_limit=*/true);
  return {content.id, outcome == InsertOutcome::known};
}

ShapeService::Posted ShapeService::post_known(const ShapeRecord& record) {
  const bool failed = record.state == ShapeState::failed;
  const bool outdated = record.state == ShapeState::ready && record.engine != engine_.version();
  if (failed || outdated) require_room();
  const bool again = (failed && store_.requeue(record.id)) || (outdated && store_.requeue_outdated(record.id, engine_.version()));
  if (again || record.state == ShapeState::queued || record.state == ShapeState::processing) submit(record.id);
  return {record.id, !again};
}

api::Shape ShapeService::get(const std::string& id) const {
  // The job first: one that ends in between has written its result, so progress is never seen to fall.
  const auto job = jobs_.status(id);
  return shape_of(record_of(id), job);
}

api::ShapePage ShapeService::list(std::size_t limit, const std::optional<std::string>& cursor, const ShapeFilter& filter) const {
  const ShapePage page = store_.list(limit, cursor, filter);
  api::ShapePage result;
  for (const ShapeRecord& record : page.shapes) result.items.push_back(shape_of(record, jobs_.status(record.id)));
  result.next_cursor = page.next_cursor;
  return result;
}

api::Shape ShapeService::change(const std::string& id, const ShapeChange& change, const std::function<bool(const api::Shape&)>& accept) {
  const auto job = jobs_.status(id);
  const auto accept_record = [&](const ShapeRecord& record) { return !accept || accept(shape_of(record, job)); };
  switch (is_shape_id(id) ? store_.change(id, change, accept_record) : ChangeOutcome::not_found) {
    case ChangeOutcome::not_found:
      throw no_such_shape(id);
    case ChangeOutcome::refused:
      throw ProblemError(api::Code::precondition_failed, "the shape has changed since it got the ETag of If-Match");
    case ChangeOutcome::changed:
      break;
  }
  return get(id);
}

void ShapeService::remove(const std::string& id) {
  if (!is_shape_id(id) || !store_.remove(id)) throw no_such_shape(id);
  jobs_.cancel(id);
  cache_.erase(id);
  // Who uploads the same bytes between the first two steps finds the old job active, and it is that one which was cancelled.
  if (store_.find(id)) jobs_.submit(id, /*beyond_limit=*/true);
  log_info("shape_removed", {{"shape", id}});
}

void ShapeService::require_known(const std::string& id) const { (void)record_of(id); }

bool ShapeService::knows(const std::string& id) const {
  try {
    return is_shape_id(id) && store_.find(id);
  } catch (const StorageError&) {
    return true;
  }
}

void ShapeService::cancel_preparation(const std::string& id) {
  (void)record_of(id);
  if (!store_.mark_failed(id, api::entry_of(api::Code::cancelled).wire, "the preparation was cancelled by a request")) {
    throw ProblemError(api::Code::job_finished, "the preparation has ended; DELETE /shapes/" + id + " removes the shape");
  }
  jobs_.cancel(id);
  log_info("preparation_cancelled", {{"shape", id}});
}

ShapeService::Usable ShapeService::require_usable(const std::string& id) const {
  const ShapeRecord record = record_of(id);
  if (record.state == ShapeState::failed) throw failed(record);
  return {record.state == ShapeState::ready && record.engine == engine_.version(), record.vertices};
}

void ShapeService::require_ready(const std::string& id, Clock::time_point deadline) {
  // Twice: a job may end without a result, for want of memory or because the shape was removed and uploaded again.
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (is_ready(id)) return;
    submit(id);
    if (!wait_until_finished(id, deadline)) throw not_ready(id);
  }
  if (!is_ready(id)) throw not_ready(id);
}

bool ShapeService::is_ready(const std::string& id) {
  const ShapeRecord record = record_of(id);
  if (record.state == ShapeState::failed) throw failed(record);
  if (record.state != ShapeState::ready) return false;
  if (record.engine == engine_.version()) return true;
  require_room();
  store_.requeue_outdated(id, engine_.version());
  return false;
}

ShapePointer ShapeService::load(const std::string& id, PreparedParts parts) {
  const ShapeRecord record = record_of(id);
  if (record.state != ShapeState::ready || record.engine != engine_.version()) throw not_ready(id);
  const bool kept = parts == PreparedParts::without_eigenbasis;
  if (ShapePointer cached = kept ? cache_.find(id) : nullptr) return cached;
  try {
    ShapePointer shape = store_.load_prepared(id, parts);
    if (kept) cache_.put(id, shape, memory_size(*shape));
    return shape;
  } catch (const StorageError& error) {
    if (error.code() != StorageErrorCode::corrupt_blob && error.code() != StorageErrorCode::unknown_version) throw;
    // The upload and its surface are blobs of their own, so what was derived from them can be made again.
    log_warning("prepared_shape_unreadable", {{"shape", id}, {"detail", error.what()}});
    require_room();
    if (store_.requeue(id)) submit(id);
    throw not_ready(id);
  }
}

ShapeService::StoredUpload ShapeService::load_upload(const std::string& id) const {
  ShapeRecord record = record_of(id);
  return {.bytes = store_.load_upload(id), .format = std::move(record.format)};
}

PolygonMesh ShapeService::load_mesh(const std::string& id) const {
  const StoredUpload upload = load_upload(id);
  return engine_.read_mesh(upload.bytes, "." + upload.format);
}

void ShapeService::stop() { jobs_.stop(); }

ShapeRecord ShapeService::record_of(const std::string& id) const {
  auto record = is_shape_id(id) ? store_.find(id) : std::nullopt;
  if (!record) throw no_such_shape(id);
  return *std::move(record);
}

void ShapeService::require_room() const {
  if (jobs_.full()) throw ProblemError(api::Code::overloaded, "too many shapes wait for their preparation; try again");
}

void ShapeService::submit(const std::string& id) {
  // Whether there is room was asked when the shape was stored or queued again. Here the store says that it is unfinished, and then
  // somebody has to work on it.
  if (jobs_.submit(id, /*beyond_limit=*/true) == JobRunner::Submitted::stopped) {
    throw ProblemError(api::Code::draining, "the server is stopping");
  }
}

bool ShapeService::wait_until_finished(const std::string& id, Clock::time_point deadline) {
  const bool may_wait = long_polls_.fetch_add(1) < settings_.max_long_polls;
  const bool finished = jobs_.wait(id, may_wait ? deadline : Clock::now());
  long_polls_.fetch_sub(1);
  return finished;
}

JobRunner::Outcome ShapeService::prepare(const std::string& id, const Progress& progress) {
  try {
    compute(id, progress);
    return JobRunner::Outcome::done;
  } catch (...) {
    if (!progress.stop.stop_requested()) return record_failure(id, progress, std::current_exception());
  }
  // Removed, or the server stops: then it stays unfinished in the store and is taken up again at the next start.
  log_info("job_cancelled", {{"shape", id}});
  return JobRunner::Outcome::done;
}

void ShapeService::compute(const std::string& id, const Progress& progress) {
  const auto record = store_.find(id);
  if (!record || (record->state == ShapeState::ready && record->engine == engine_.version())) return;
  store_.mark_processing(id);
  const auto started = Clock::now();
  log_info("job_started", {{"shape", id}, {"vertices", record->vertices}});
  StageLog stages(id, progress);
  const auto shape = std::make_shared<PreprocessedShape>(engine_.preprocess(store_.load_surface(id), stages.progress()));
  progress.check();
  const bool saved = store_.save_prepared(id, *shape);
  shape->eigenvalues.resize(0);
  shape->eigenvectors.resize(0, 0);
  if (saved) cache_.put(id, shape, memory_size(*shape));
  for (const auto& [stage, seconds] : shape->seconds) {
    if (settings_.on_stage) settings_.on_stage(stage, seconds);
  }
  std::vector<LogField> fields{{"shape", id}, {"saved", saved}, {"seconds", seconds_since(started)}};
  for (const auto& [stage, seconds] : shape->seconds) fields.emplace_back(stage, seconds);
  log_info("job_finished", fields);
}

JobRunner::Outcome ShapeService::record_failure(const std::string& id, const Progress& progress, const std::exception_ptr& exception) {
  try {
    const ProblemError error = preparation_problem(exception);
    const api::Problem& problem = error.problem();
    const bool lost =
        problem.code == api::Code::internal || problem.code == api::Code::overloaded || problem.code == api::Code::insufficient_storage;
    const int attempt = lost ? store_.count_lost_attempt(id) : max_attempts;
    const std::string_view code = api::entry_of(problem.code).wire;
    log_warning("job_failed", {{"shape", id}, {"code", code}, {"attempt", attempt}, {"detail", problem.detail}});
    if (attempt == 0) return JobRunner::Outcome::done;  // removed meanwhile
    if (attempt < max_attempts) {
      pause(progress.stop, settings_.pause_after_loss);
      return JobRunner::Outcome::again;
    }
    store_.mark_failed(id, code, problem.detail);
  } catch (const std::exception& error) {
    log_error("failure_not_stored", {{"shape", id}, {"detail", error.what()}});
  }
  return JobRunner::Outcome::done;
}

}  // namespace spherematch
