#include "storage/match_store.h"

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>

#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "storage/match_codec.h"
#include "storage/shape_rows.h"
#include "storage/transaction.h"

namespace spherematch {
namespace {

/// A use is written down only when the last one is so long ago: a write costs more than a read.
constexpr std::int64_t seconds_between_uses = 600;

struct Found {
  std::vector<std::byte> blob;
  std::int64_t used_at = 0;
};

std::int64_t now() { return static_cast<std::int64_t>(std::time(nullptr)); }

void forget(SQLite::Database& database, std::string_view key) {
  SQLite::Statement statement(database, "DELETE FROM matches WHERE key = ?");
  statement.bind(1, std::string(key));
  statement.exec();
}

void forget_outdated(SQLite::Database& database, Sequence shape, std::string_view engine) {
  for (const char* side : {"source", "target"}) {
    SQLite::Statement statement(database, std::string("DELETE FROM matches WHERE ") + side + " = ? AND engine <> ?");
    statement.bind(1, shape);
    statement.bind(2, std::string(engine));
    statement.exec();
  }
}

std::int64_t total_bytes(SQLite::Database& database) {
  return database.execAndGet("SELECT coalesce(sum(bytes), 0) FROM matches").getInt64();
}

/// Drops the least recently used until so many bytes are free below the bound.
void make_room(SQLite::Database& database, std::int64_t wanted, std::int64_t max_bytes) {
  std::int64_t excess = total_bytes(database) + wanted - max_bytes;
  if (excess <= 0) return;
  std::vector<std::int64_t> rows;
  SQLite::Statement query(database, "SELECT rowid, bytes FROM matches ORDER BY used_at, rowid");
  while (excess > 0 && query.executeStep()) {
    rows.push_back(query.getColumn(0).getInt64());
    excess -= query.getColumn(1).getInt64();
  }
  SQLite::Statement drop(database, "DELETE FROM matches WHERE rowid = ?");
  for (const std::int64_t row : rows) {
    drop.bind(1, row);
    drop.exec();
    drop.reset();
  }
}

void insert(SQLite::Database& database, std::string_view key, Sequence source, Sequence target, std::string_view engine,
            const std::vector<std::byte>& blob) {
  SQLite::Statement statement(database,
                              "INSERT INTO matches (key, source, target, engine, used_at, bytes, data) VALUES (?, ?, ?, ?, ?, ?, ?)");
  statement.bind(1, std::string(key));
  statement.bind(2, source);
  statement.bind(3, target);
  statement.bind(4, std::string(engine));
  statement.bind(5, now());
  statement.bind(6, static_cast<std::int64_t>(blob.size()));
  statement.bindNoCopy(7, blob.data(), static_cast<int>(blob.size()));  // at most max_blob_size
  statement.exec();
}

}  // namespace

MatchStore::MatchStore(const ShapeStore& shapes, std::size_t max_bytes) : pool_(shapes.pool()), max_bytes_(max_bytes) {}

std::shared_ptr<const MatchResult> MatchStore::find(std::string_view key) {
  if (max_bytes_ == 0) return nullptr;
  const auto found = read(*pool_, [&](SQLite::Database& database) -> std::optional<Found> {
    SQLite::Statement query(database, "SELECT data, used_at FROM matches WHERE key = ?");
    query.bind(1, std::string(key));
    if (!query.executeStep()) return std::nullopt;
    const SQLite::Column data = query.getColumn(0);
    const auto* bytes = static_cast<const std::byte*>(data.getBlob());
    return Found{{bytes, bytes + data.getBytes()}, query.getColumn(1).getInt64()};
  });
  if (!found) return nullptr;
  try {
    auto result = std::make_shared<const MatchResult>(decode_match(found->blob));
    if (now() - found->used_at >= seconds_between_uses) {
      write(*pool_, [&](SQLite::Database& database) {
        SQLite::Statement statement(database, "UPDATE matches SET used_at = ? WHERE key = ?");
        statement.bind(1, now());
        statement.bind(2, std::string(key));
        return statement.exec();
      });
    }
    return result;
  } catch (const StorageError& error) {
    if (error.code() != StorageErrorCode::corrupt_blob && error.code() != StorageErrorCode::unknown_version) throw;
    return write(*pool_, [&](SQLite::Database& database) -> std::shared_ptr<const MatchResult> {
      forget(database, key);
      return nullptr;
    });
  }
}

bool MatchStore::save(std::string_view key, std::string_view source, std::string_view target, std::string_view engine,
                      const MatchResult& result) {
  if (max_bytes_ == 0) return false;
  const std::vector<std::byte> blob = encode_match(result);
  if (blob.size() > max_bytes_) return false;
  return write(*pool_, [&](SQLite::Database& database) {
    const auto source_row = find_row(database, source);
    const auto target_row = find_row(database, target);
    if (!source_row || !target_row) return false;
    forget(database, key);
    forget_outdated(database, source_row->sequence, engine);
    forget_outdated(database, target_row->sequence, engine);
    make_room(database, static_cast<std::int64_t>(blob.size()), static_cast<std::int64_t>(max_bytes_));
    insert(database, key, source_row->sequence, target_row->sequence, engine, blob);
    return true;
  });
}

std::size_t MatchStore::bytes() const {
  return read(*pool_, [](SQLite::Database& database) { return static_cast<std::size_t>(total_bytes(database)); });
}

}  // namespace spherematch
