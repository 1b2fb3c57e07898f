#include "storage/job_store.h"

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>

#include <algorithm>
#include <array>
#include <limits>

#include "storage/transaction.h"

namespace spherematch {
namespace {

constexpr std::array<std::string_view, 2> kind_names{"preprocess", "match"};
constexpr std::array<std::string_view, 5> state_names{"queued", "processing", "succeeded", "failed", "cancelled"};

// The time at which a row is written, as SQLite's own function gives it.
constexpr const char* now = "strftime('%Y-%m-%dT%H:%M:%fZ', 'now')";

// Both kinds of jobs as one table; read_job() reads its columns in this order. A shape's last preparation is a job for as long as the
// shape is there.
constexpr const char* all_jobs = R"sql(
SELECT id, kind, state, created_at, started_at, finished_at, shape, error_code, error_detail, options, pairs, finished, failed FROM (
  SELECT 'p' || id AS id, 'preprocess' AS kind, CASE state WHEN 'ready' THEN 'succeeded' ELSE state END AS state, created_at, started_at,
         finished_at, id AS shape, error_code, error_detail, '' AS options, 0 AS pairs, 0 AS finished, 0 AS failed
  FROM shapes
  UNION ALL
  SELECT id, 'match', state, created_at, started_at, finished_at, '', '', '', options, pairs,
         (SELECT count(*) FROM match_job_pairs WHERE job = sequence AND line IS NOT NULL),
         (SELECT count(*) FROM match_job_pairs WHERE job = sequence AND line IS NOT NULL AND error_code <> '')
  FROM match_jobs)
)sql";

template <typename Enum, std::size_t Size>
Enum named(const std::array<std::string_view, Size>& names, const std::string& text) {
  return static_cast<Enum>(std::find(names.begin(), names.end(), text) - names.begin());
}

JobRecord read_job(SQLite::Statement& row) {
  JobRecord job;
  job.id = row.getColumn(0).getString();
  job.kind = named<JobKind>(kind_names, row.getColumn(1).getString());
  job.state = named<JobState>(state_names, row.getColumn(2).getString());
  job.created_at = row.getColumn(3).getString();
  job.started_at = row.getColumn(4).getString();
  job.finished_at = row.getColumn(5).getString();
  job.shape = row.getColumn(6).getString();
  job.error_code = row.getColumn(7).getString();
  job.error_detail = row.getColumn(8).getString();
  job.options = row.getColumn(9).getString();
  job.pairs = row.getColumn(10).getInt();
  job.finished_pairs = row.getColumn(11).getInt();
  job.failed_pairs = row.getColumn(12).getInt();
  return job;
}

JobPair read_pair(SQLite::Statement& row) {
  return {row.getColumn(0).getInt(), row.getColumn(1).getString(), row.getColumn(2).getString(), row.getColumn(3).getString(),
          row.getColumn(4).getString()};
}

void prune(SQLite::Database& database, std::int64_t keep_finished) {
  SQLite::Statement statement(database,
                              "DELETE FROM match_jobs WHERE sequence IN (SELECT sequence FROM match_jobs WHERE state IN ('succeeded', "
                              "'cancelled') ORDER BY sequence DESC LIMIT -1 OFFSET ?)");
  statement.bind(1, keep_finished);
  statement.exec();
}

/// The sequence number of an active match job.
std::optional<std::int64_t> active_job(SQLite::Database& database, std::string_view id) {
  SQLite::Statement query(database, "SELECT sequence FROM match_jobs WHERE id = ? AND state IN ('queued', 'processing')");
  query.bind(1, std::string(id));
  return query.executeStep() ? std::optional(query.getColumn(0).getInt64()) : std::nullopt;
}

void finish_if_complete(SQLite::Database& database, std::int64_t job) {
  SQLite::Statement statement(database,
                              std::string("UPDATE match_jobs SET state = 'succeeded', finished_at = ") + now +
                                  " WHERE sequence = ? AND NOT EXISTS (SELECT 1 FROM match_job_pairs WHERE job = ? AND line IS NULL)");
  statement.bind(1, job);
  statement.bind(2, job);
  statement.exec();
}

/// A cursor is the creation time and the id of the last job of a page: together they are unique and never change.
std::pair<std::string, std::string> parse_cursor(const std::string& cursor) {
  const auto comma = cursor.find('_');
  if (comma == std::string::npos || comma + 1 == cursor.size()) {
    throw StorageError(StorageErrorCode::invalid_cursor, "the cursor is not one that a page of jobs gave out");
  }
  return {cursor.substr(0, comma), cursor.substr(comma + 1)};
}

std::string conditions(const std::optional<std::string>& cursor, const JobFilter& filter) {
  std::string text = " WHERE 1";
  if (cursor) text += " AND (created_at, id) < (:time, :id)";
  if (filter.kind) text += " AND kind = :kind";
  if (filter.state) text += " AND state = :state";
  return text + " ORDER BY created_at DESC, id DESC LIMIT :limit";
}

}  // namespace

std::string_view to_string(JobKind kind) { return kind_names.at(static_cast<std::size_t>(kind)); }

std::string_view to_string(JobState state) { return state_names.at(static_cast<std::size_t>(state)); }

void JobStore::create(std::string_view id, std::string_view options, const std::vector<std::pair<std::string, std::string>>& pairs,
                      std::int64_t keep_finished) {
  write(*pool_, [&](SQLite::Database& database) {
    prune(database, keep_finished);
    SQLite::Statement job(
        database, std::string("INSERT INTO match_jobs (id, options, state, pairs, created_at) VALUES (?, ?, 'queued', ?, ") + now + ")");
    job.bind(1, std::string(id));
    job.bind(2, std::string(options));
    job.bind(3, static_cast<std::int64_t>(pairs.size()));
    job.exec();
    const std::int64_t sequence = database.getLastInsertRowid();
    SQLite::Statement pair(database, "INSERT INTO match_job_pairs (job, position, source, target) VALUES (?, ?, ?, ?)");
    for (std::size_t position = 0; position < pairs.size(); ++position) {
      pair.bind(1, sequence);
      pair.bind(2, static_cast<std::int64_t>(position));
      pair.bind(3, pairs[position].first);
      pair.bind(4, pairs[position].second);
      pair.exec();
      pair.reset();
    }
    return true;
  });
}

std::optional<JobRecord> JobStore::find(std::string_view id) const {
  return read(*pool_, [&](SQLite::Database& database) -> std::optional<JobRecord> {
    SQLite::Statement query(database, std::string(all_jobs) + " WHERE id = ?");
    query.bind(1, std::string(id));
    return query.executeStep() ? std::optional(read_job(query)) : std::nullopt;
  });
}

JobPage JobStore::list(std::size_t limit, const std::optional<std::string>& cursor, const JobFilter& filter) const {
  return read(*pool_, [&](SQLite::Database& database) {
    SQLite::Statement query(database, all_jobs + conditions(cursor, filter));
    if (cursor) {
      const auto [time, id] = parse_cursor(*cursor);
      query.bind(":time", time);
      query.bind(":id", id);
    }
    if (filter.kind) query.bind(":kind", std::string(to_string(*filter.kind)));
    if (filter.state) query.bind(":state", std::string(to_string(*filter.state)));
    query.bind(":limit", static_cast<std::int64_t>(limit) + 1);  // one more than asked for tells whether a next page exists
    JobPage page;
    while (query.executeStep()) page.jobs.push_back(read_job(query));
    if (page.jobs.size() > limit) {
      page.jobs.pop_back();
      page.next_cursor = page.jobs.back().created_at + "_" + page.jobs.back().id;
    }
    return page;
  });
}

std::vector<std::string> JobStore::unfinished() const {
  return read(*pool_, [](SQLite::Database& database) {
    SQLite::Statement query(database, "SELECT id FROM match_jobs WHERE state IN ('queued', 'processing') ORDER BY sequence");
    std::vector<std::string> ids;
    while (query.executeStep()) ids.push_back(query.getColumn(0).getString());
    return ids;
  });
}

std::vector<JobPair> JobStore::open_pairs(std::string_view id) const {
  return read(*pool_, [&](SQLite::Database& database) {
    SQLite::Statement query(database,
                            "SELECT position, source, target, error_code, error_detail FROM match_job_pairs "
                            "WHERE job = (SELECT sequence FROM match_jobs WHERE id = ?) AND line IS NULL ORDER BY position");
    query.bind(1, std::string(id));
    std::vector<JobPair> pairs;
    while (query.executeStep()) pairs.push_back(read_pair(query));
    return pairs;
  });
}

void JobStore::mark_started(std::string_view id) {
  write(*pool_, [&](SQLite::Database& database) {
    SQLite::Statement statement(
        database, std::string("UPDATE match_jobs SET state = 'processing', started_at = ") + now + " WHERE id = ? AND state = 'queued'");
    statement.bind(1, std::string(id));
    return statement.exec();
  });
}

bool JobStore::finish_pair(std::string_view id, std::int32_t position, std::string_view error_code, std::string_view error_detail) {
  return write(*pool_, [&](SQLite::Database& database) {
    const auto job = active_job(database, id);
    if (!job) return false;
    SQLite::Statement statement(
        database,
        "UPDATE match_job_pairs SET line = (SELECT coalesce(max(line), 0) + 1 FROM match_job_pairs WHERE job = ?1 "
        "AND line IS NOT NULL), error_code = ?3, error_detail = ?4 WHERE job = ?1 AND position = ?2 AND line IS NULL");
    statement.bind(1, *job);
    statement.bind(2, position);
    statement.bind(3, std::string(error_code));
    statement.bind(4, std::string(error_detail));
    if (statement.exec() == 0) return false;
    finish_if_complete(database, *job);
    return true;
  });
}

bool JobStore::cancel(std::string_view id) {
  return write(*pool_, [&](SQLite::Database& database) {
    SQLite::Statement statement(database, std::string("UPDATE match_jobs SET state = 'cancelled', finished_at = ") + now +
                                              " WHERE id = ? AND state IN ('queued', 'processing')");
    statement.bind(1, std::string(id));
    return statement.exec() > 0;
  });
}

bool JobStore::remove(std::string_view id) {
  return write(*pool_, [&](SQLite::Database& database) {
    SQLite::Statement statement(database, "DELETE FROM match_jobs WHERE id = ? AND state IN ('succeeded', 'cancelled')");
    statement.bind(1, std::string(id));
    return statement.exec() > 0;
  });
}

std::vector<JobPair> JobStore::lines(std::string_view id, std::int32_t after, std::int32_t limit) const {
  return read(*pool_, [&](SQLite::Database& database) {
    SQLite::Statement query(database,
                            "SELECT position, source, target, error_code, error_detail FROM match_job_pairs "
                            "WHERE job = (SELECT sequence FROM match_jobs WHERE id = ?) AND line > ? ORDER BY line LIMIT ?");
    query.bind(1, std::string(id));
    query.bind(2, after);
    query.bind(3, limit);
    std::vector<JobPair> pairs;
    while (query.executeStep()) pairs.push_back(read_pair(query));
    return pairs;
  });
}

}  // namespace spherematch
