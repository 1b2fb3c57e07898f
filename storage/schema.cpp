#include "storage/schema.h"

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Transaction.h>
#include <sqlite3.h>

#include <array>
#include <chrono>
#include <string>
#include <thread>

#include "storage/error.h"

namespace spherematch {
namespace {

// Tells a store from other programs' SQLite files: "SphM".
constexpr int application_id = 0x5370684d;

// `sequence` orders shapes by their insertion and is never used twice, so it serves as a page cursor. Blobs refer to it rather
// than to the id. Large values stand in a table of their own, so that listing shapes does not read past them.
constexpr const char* first_schema = R"sql(
CREATE TABLE shapes (
  sequence INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE,
  name TEXT NOT NULL,
  sha256 TEXT NOT NULL,
  options TEXT NOT NULL,
  state TEXT NOT NULL CHECK (state IN ('queued', 'processing', 'ready', 'failed')),
  vertices INTEGER NOT NULL,
  faces INTEGER NOT NULL,
  filled_loops INTEGER NOT NULL,
  added_vertices INTEGER NOT NULL,
  added_faces INTEGER NOT NULL,
  dropped_vertices INTEGER NOT NULL,
  welded_vertices INTEGER NOT NULL,
  split_vertices INTEGER NOT NULL,
  flipped_faces INTEGER NOT NULL,
  removed_faces INTEGER NOT NULL,
  dropped_components INTEGER NOT NULL,
  sphere_flipped INTEGER,
  solid_angle_defect REAL,
  area_distortion REAL,
  engine TEXT NOT NULL DEFAULT '',
  error_code TEXT NOT NULL DEFAULT '',
  error_detail TEXT NOT NULL DEFAULT '',
  created_at TEXT NOT NULL
) STRICT;
CREATE INDEX shapes_unfinished ON shapes (sequence) WHERE state IN ('queued', 'processing');
CREATE TABLE stage_seconds (
  shape INTEGER NOT NULL REFERENCES shapes (sequence) ON DELETE CASCADE,
  position INTEGER NOT NULL,
  stage TEXT NOT NULL,
  seconds REAL NOT NULL,
  PRIMARY KEY (shape, position)
) STRICT, WITHOUT ROWID;
CREATE TABLE blobs (
  shape INTEGER NOT NULL REFERENCES shapes (sequence) ON DELETE CASCADE,
  kind INTEGER NOT NULL,
  data BLOB NOT NULL,
  UNIQUE (shape, kind)
) STRICT;
)sql";

constexpr const char* count_attempts = "ALTER TABLE shapes ADD COLUMN attempts INTEGER NOT NULL DEFAULT 0;";

// Results of matches, and jobs of many pairs. `used_at` (seconds since 1970) says what may go when the table grows too large; the
// index holds all that this decision needs. A pair of a job has a `line` once it is finished: its place among the results.
constexpr const char* matches_and_jobs = R"sql(
CREATE TABLE matches (
  key TEXT NOT NULL UNIQUE,
  source INTEGER NOT NULL REFERENCES shapes (sequence) ON DELETE CASCADE,
  target INTEGER NOT NULL REFERENCES shapes (sequence) ON DELETE CASCADE,
  engine TEXT NOT NULL,
  used_at INTEGER NOT NULL,
  bytes INTEGER NOT NULL,
  data BLOB NOT NULL
) STRICT;
CREATE INDEX matches_used ON matches (used_at, bytes);
CREATE INDEX matches_source ON matches (source, engine);
CREATE INDEX matches_target ON matches (target, engine);
CREATE TABLE match_jobs (
  sequence INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE,
  options TEXT NOT NULL,
  state TEXT NOT NULL CHECK (state IN ('queued', 'processing', 'succeeded', 'cancelled')),
  pairs INTEGER NOT NULL,
  created_at TEXT NOT NULL,
  started_at TEXT,
  finished_at TEXT
) STRICT;
CREATE TABLE match_job_pairs (
  job INTEGER NOT NULL REFERENCES match_jobs (sequence) ON DELETE CASCADE,
  position INTEGER NOT NULL,
  source TEXT NOT NULL,
  target TEXT NOT NULL,
  line INTEGER,
  error_code TEXT NOT NULL DEFAULT '',
  error_detail TEXT NOT NULL DEFAULT '',
  PRIMARY KEY (job, position)
) STRICT, WITHOUT ROWID;
CREATE UNIQUE INDEX match_job_lines ON match_job_pairs (job, line) WHERE line IS NOT NULL;
ALTER TABLE shapes ADD COLUMN started_at TEXT;
ALTER TABLE shapes ADD COLUMN finished_at TEXT;
)sql";

constexpr const char* note_simplified = "ALTER TABLE shapes ADD COLUMN simplified INTEGER;";

// The format is what an upload was recognised as, so that it can be read again under any name. Of older uploads it is what the name
// ends in, which is all that was known.
constexpr const char* label_shapes = R"sql(
ALTER TABLE shapes ADD COLUMN format TEXT NOT NULL DEFAULT '';
UPDATE shapes SET format = substr(lower(name), -3) WHERE substr(lower(name), -4) IN ('.ply', '.glb', '.off', '.stl', '.obj');
UPDATE shapes SET format = 'gltf' WHERE substr(lower(name), -5) = '.gltf';
CREATE INDEX shapes_by_sha256 ON shapes (sha256);
CREATE TABLE shape_tags (
  shape INTEGER NOT NULL REFERENCES shapes (sequence) ON DELETE CASCADE,
  tag TEXT NOT NULL,
  PRIMARY KEY (shape, tag)
) STRICT, WITHOUT ROWID;
CREATE INDEX shapes_by_tag ON shape_tags (tag, shape);
)sql";

constexpr std::array steps{first_schema, count_attempts, matches_and_jobs, note_simplified, label_shapes};

int pragma(SQLite::Database& database, const char* name) { return database.execAndGet(std::string("PRAGMA ") + name).getInt(); }

/// The version of the file's schema, 0 for an empty file. Inside a transaction, so that all that is asked is of one moment.
int checked_version(SQLite::Database& database) {
  const int version = pragma(database, "user_version");
  const int owner = pragma(database, "application_id");
  const bool empty = database.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0;
  const bool ours = owner == application_id ? version > 0 : (owner == 0 && version == 0 && empty);
  if (!ours) {
    throw StorageError(StorageErrorCode::not_a_store, "\"" + database.getFilename() + "\" is a database of another program");
  }
  if (version > schema_version()) {
    throw StorageError(StorageErrorCode::newer_schema, "\"" + database.getFilename() + "\" has schema version " + std::to_string(version) +
                                                           ", written by a newer release; this release reads up to version " +
                                                           std::to_string(schema_version()));
  }
  return version;
}

int version_now(SQLite::Database& database) {
  const SQLite::Transaction snapshot(database);
  return checked_version(database);
}

/// A file's first change to write-ahead logging needs a lock for which SQLite does not call the busy handler.
void use_write_ahead_log(SQLite::Database& database, std::chrono::milliseconds busy_timeout) {
  using std::chrono::steady_clock;
  const auto deadline = steady_clock::now() + busy_timeout;
  while (true) {
    try {
      const std::string mode = database.execAndGet("PRAGMA journal_mode = WAL").getString();
      if (mode != "wal") throw StorageError(StorageErrorCode::io, "the store's file system does not support write-ahead logging");
      return;
    } catch (const SQLite::Exception& error) {
      if (error.getErrorCode() != SQLITE_BUSY || steady_clock::now() > deadline) throw;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace

int schema_version() { return static_cast<int>(steps.size()); }

void migrate(SQLite::Database& database, std::chrono::milliseconds busy_timeout) {
  // Before anything is written, so that a file which is refused stays untouched.
  const int found = version_now(database);
  // For blobs of megabytes; takes effect while the file is empty only.
  if (found == 0) database.exec("PRAGMA page_size = 16384");
  use_write_ahead_log(database, busy_timeout);
  if (found == schema_version()) return;

  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  // Again under the lock: another process may have migrated in between.
  const auto done = static_cast<std::size_t>(checked_version(database));
  for (std::size_t step = done; step < steps.size(); ++step) database.exec(steps[step]);
  database.exec("PRAGMA application_id = " + std::to_string(application_id));
  database.exec("PRAGMA user_version = " + std::to_string(schema_version()));
  transaction.commit();
}

}  // namespace spherematch
