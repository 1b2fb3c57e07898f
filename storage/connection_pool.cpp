#include "storage/connection_pool.h"

#include <SQLiteCpp/Database.h>
#include <sqlite3.h>

#include <utility>

#include "storage/schema.h"

namespace spherematch {

ConnectionPool::Lease::Lease(ConnectionPool& pool, std::unique_ptr<SQLite::Database> connection)
    : pool_(pool), connection_(std::move(connection)) {}

ConnectionPool::Lease::~Lease() {
  // A connection whose rollback failed is closed instead of lent again.
  if (sqlite3_get_autocommit(connection_->getHandle()) == 0) connection_.reset();
  pool_.take_back(std::move(connection_));
}

ConnectionPool::ConnectionPool(std::filesystem::path file, std::chrono::milliseconds busy_timeout)
    : file_(std::move(file)), busy_timeout_(busy_timeout) {
  if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path());
  auto first = open();
  migrate(*first, busy_timeout_);
  free_.push_back(std::move(first));
}

ConnectionPool::~ConnectionPool() = default;

ConnectionPool::Lease ConnectionPool::lease() {
  {
    std::unique_lock lock(free_mutex_);
    returned_.wait(lock, [this] { return leased_ < max_connections; });
    ++leased_;
    if (!free_.empty()) {
      auto connection = std::move(free_.back());
      free_.pop_back();
      return {*this, std::move(connection)};
    }
  }
  try {
    return {*this, open()};
  } catch (...) {
    take_back(nullptr);
    throw;
  }
}

void ConnectionPool::take_back(std::unique_ptr<SQLite::Database> connection) {
  {
    const std::lock_guard lock(free_mutex_);
    --leased_;
    if (connection) free_.push_back(std::move(connection));
  }
  returned_.notify_one();
}

std::unique_ptr<SQLite::Database> ConnectionPool::open() const {
  const int flags = SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE | SQLite::OPEN_NOMUTEX;
  auto connection = std::make_unique<SQLite::Database>(file_.string(), flags, static_cast<int>(busy_timeout_.count()));
  // FULL syncs the log at every commit: an acknowledged upload then survives a power failure, not only the end of the process.
  // That costs some milliseconds per upload, next to seconds of preparation.
  connection->exec("PRAGMA synchronous = FULL");
  connection->exec("PRAGMA foreign_keys = ON");
  // The log is cut back after a large write instead of keeping the largest size it ever had.
  connection->exec("PRAGMA journal_size_limit = 67108864");
  return connection;
}

}  // namespace spherematch
