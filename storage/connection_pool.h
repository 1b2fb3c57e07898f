// SQLite connections to one file, each used by one thread at a time.
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include "storage/sqlite_forward.h"

namespace spherematch {

class ConnectionPool {
 public:
  static constexpr std::size_t max_connections = 16;

  /// One connection, back in the pool when it is destroyed. Must not outlive the pool.
  class Lease {
   public:
    Lease(ConnectionPool& pool, std::unique_ptr<SQLite::Database> connection);
    ~Lease();
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;

    [[nodiscard]] SQLite::Database& operator*() const { return *connection_; }

   private:
    ConnectionPool& pool_;
    std::unique_ptr<SQLite::Database> connection_;
  };

  /// Opens the file, creating it and its directory where missing, and migrates its schema.
  /// @throws StorageError, SQLite::Exception, std::filesystem::filesystem_error
  ConnectionPool(std::filesystem::path file, std::chrono::milliseconds busy_timeout);
  ~ConnectionPool();
  ConnectionPool(const ConnectionPool&) = delete;
  ConnectionPool& operator=(const ConnectionPool&) = delete;

  /// A free connection or a new one. Beyond `max_connections` it waits for one to come back: many threads at once would spend more
  /// time on opening connections than on their work. A thread that holds a lease must not ask for another.
  /// @throws SQLite::Exception
  [[nodiscard]] Lease lease();

  /// Held around every write: threads of one process then wait for each other in turn instead of polling SQLite's lock.
  [[nodiscard]] std::mutex& write_mutex() { return write_mutex_; }

 private:
  /// A null pointer takes nothing back but the right to be one of them.
  void take_back(std::unique_ptr<SQLite::Database> connection);
  [[nodiscard]] std::unique_ptr<SQLite::Database> open() const;

  std::filesystem::path file_;
  std::chrono::milliseconds busy_timeout_;
  std::mutex free_mutex_;
  std::condition_variable returned_;
  std::vector<std::unique_ptr<SQLite::Database>> free_;
  std::size_t leased_ = 0;
  std::mutex write_mutex_;
};

}  // namespace spherematch
