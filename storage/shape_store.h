// Keeps shapes in one SQLite file: the upload, the repaired surface, and what preprocessing made of it.
//
// Thread-safe, and safe beside other processes on the same file. Every change is one transaction that is on the disk when the
// function returns; a process killed at any moment leaves each shape either as before or as after. Every function throws
// StorageError: `busy`, `full` or `io` for what happens to the file, `corrupt_blob` or `unknown_version` where it reads a
// blob, and what is named at it. An id that is not stored is `not_found` or `false`, as each function says.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/data/preprocessed_shape.h"
#include "storage/blob_codec.h"
#include "storage/content_id.h"
#include "storage/error.h"

namespace spherematch {

class ConnectionPool;

enum class ShapeState { queued, processing, ready, failed };

/// "queued", "processing", "ready" or "failed".
[[nodiscard]] std::string_view to_string(ShapeState state);

/// What is said of an upload and is no part of its identity.
struct ShapeLabels {
  std::string name;               ///< may be empty
  std::string format;             ///< what the upload was recognised as, "off" and the like; empty where nothing was
  std::vector<std::string> tags;  ///< a set: kept in ascending order, each once
};

/// Everything about a shape except its arrays.
struct ShapeRecord {
  std::string id;
  std::string name;    ///< of the first upload, or as changed since
  std::string format;  ///< of the first upload
  std::vector<std::string> tags;
  std::string sha256;
  std::string options;
  ShapeState state = ShapeState::queued;
  std::int32_t vertices = 0;  ///< of the upload
  std::int32_t faces = 0;     ///< polygons of the upload
  RepairReport repair;
  std::optional<std::int32_t> simplified;  ///< vertices of the surface's decimated copy, if it has one
  std::optional<SphereQuality> sphere;     ///< once ready
  StageSeconds seconds;                    ///< once ready
  std::string engine;                      ///< once ready: the engine version that prepared it
  std::string error_code;                  ///< once failed: a stable code
  std::string error_detail;                ///< once failed: a sentence
  std::string created_at;                  ///< RFC 3339, UTC, of the first upload
};

enum class InsertOutcome {
  inserted,      ///< new; queued
  known,         ///< already there; nothing changed
  queued_again,  ///< was failed; queued, its error forgotten
};

/// Shapes that a list is about: those that have everything that is set here.
struct ShapeFilter {
  std::optional<ShapeState> state;
  std::string tag;
  std::string name_part;  ///< capitals of ASCII count as their small letters
  std::string sha256;
};

/// Only what is set changes.
struct ShapeChange {
  std::optional<std::string> name;
  std::optional<std::vector<std::string>> tags;
};

enum class ChangeOutcome { changed, refused, not_found };

struct ShapePage {
  std::vector<ShapeRecord> shapes;         ///< newest first
  std::optional<std::string> next_cursor;  ///< engaged when older shapes remain
};

/// What is read of a prepared shape. Each part is stored and checked by itself; the eigenbasis takes nine tenths of the bytes.
enum class PreparedParts { all, without_eigenbasis };

class ShapeStore {
 public:
  /// Opens the file, creating it and its directory where missing, and migrates an older schema. A write waits for another
  /// process's write for up to `busy_timeout`, by default far above what the longest write takes.
  /// @throws StorageError(not_a_store, newer_schema)
  explicit ShapeStore(const std::filesystem::path& file, std::chrono::milliseconds busy_timeout = std::chrono::seconds(30));
  ~ShapeStore();
  ShapeStore(const ShapeStore&) = delete;
  ShapeStore& operator=(const ShapeStore&) = delete;

  /// Stores an upload and its surface under `content.id`. Idempotent: of concurrent inserts one is `inserted`, and its labels stay.
  /// @throws StorageError(too_large)
  InsertOutcome insert(const ContentId& content, const ShapeLabels& labels, std::span<const std::byte> upload, const Surface& surface);

  [[nodiscard]] std::optional<ShapeRecord> find(std::string_view id) const;

  /// At most `limit` (at least 1) shapes, newest first, from the cursor of the page before or from the newest on. Shapes
  /// inserted or removed between two pages neither repeat nor hide another. A cursor serves any filter.
  /// @throws StorageError(invalid_cursor)
  [[nodiscard]] ShapePage list(std::size_t limit, const std::optional<std::string>& cursor = std::nullopt,
                               const ShapeFilter& filter = {}) const;

  /// Changes a shape's labels, unless `accept` says no to what they are now; it is asked under the write lock, so that of two
  /// changes to the same state one is refused. An empty `accept` says yes.
  ChangeOutcome change(std::string_view id, const ShapeChange& change, const std::function<bool(const ShapeRecord&)>& accept = {});

  /// Removes a shape and everything derived from it; false when it is not there.
  bool remove(std::string_view id);

  // Preparation. Each returns whether the change was made, so that one of several workers wins.

  bool mark_processing(std::string_view id);                                              ///< queued -> processing
  bool mark_failed(std::string_view id, std::string_view code, std::string_view detail);  ///< queued, processing -> failed
  /// Counts a preparation that ended without a result and without an error of the shape's own, as when its process crashed. Returns
  /// how many there were since the shape was queued; 0 when it is not queued or processing. Forgotten with requeue() and when ready.
  int count_lost_attempt(std::string_view id);
  /// Any state -> ready; false, with nothing stored, when the shape was removed meanwhile. `shape.surface` takes the place of
  /// the stored one, since another engine version may repair an upload differently.
  /// @throws StorageError(too_large)
  bool save_prepared(std::string_view id, const PreprocessedShape& shape);

  /// Ready or failed -> queued; what was prepared is dropped. For a preparation that turns out to be unreadable.
  bool requeue(std::string_view id);
  /// requeue() of a ready shape that was prepared by another engine version than the given one.
  bool requeue_outdated(std::string_view id, std::string_view current_engine);
  /// Processing -> queued, for the start of a server: whoever processed these is gone. Returns all queued ids in the order in which
  /// they should be prepared: the oldest first, but behind all others those that were under way, and last those with lost attempts.
  /// So a shape whose preparation brings down a server does not keep the next server from the others.
  std::vector<std::string> requeue_unfinished();
  /// Ids that are queued or processing, oldest first.
  [[nodiscard]] std::vector<std::string> unfinished() const;

  /// The uploaded bytes. @throws StorageError(not_found)
  [[nodiscard]] std::vector<std::byte> load_upload(std::string_view id) const;
  /// @throws StorageError(not_found)
  [[nodiscard]] Surface load_surface(std::string_view id) const;
  /// Bit for bit what save_prepared() got, but for parts that are left out, which are then empty.
  /// @throws StorageError(not_found) also when the shape is not ready
  [[nodiscard]] std::shared_ptr<const PreprocessedShape> load_prepared(std::string_view id, PreparedParts parts = PreparedParts::all) const;
  /// The part that load_prepared() can leave out. @throws StorageError(not_found) also when the shape is not ready
  [[nodiscard]] StoredEigenbasis load_eigenbasis(std::string_view id) const;

  /// Makes a write that changes nothing and is on the disk when this returns: whether the store takes writes.
  void check_writable();

  /// For the other stores on the same file.
  [[nodiscard]] const std::shared_ptr<ConnectionPool>& pool() const { return pool_; }

 private:
  std::shared_ptr<ConnectionPool> pool_;
};

}  // namespace spherematch
