// How the stores use their file. Internal to storage/.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "storage/connection_pool.h"
#include "storage/sqlite_forward.h"

namespace spherematch {

/// @throws StorageError(not_a_store, newer_schema, io, busy)
[[nodiscard]] std::shared_ptr<ConnectionPool> open_store(const std::filesystem::path& file, std::chrono::milliseconds busy_timeout);

enum class Access { read, write };

/// Runs use(database) in a transaction. SQLite's errors become StorageError, or std::bad_alloc. A transaction that writes takes the lock
/// at its start, so that a decision made on what was read stays right, and waiting for it never fails half-way; it is committed unless
/// `use` throws.
void in_transaction(ConnectionPool& pool, Access access, const std::function<void(SQLite::Database&)>& use);

/// What use(database) returns, in a transaction whose reads agree with each other.
template <typename Use>
auto read(ConnectionPool& pool, Use use) {
  std::optional<std::invoke_result_t<Use, SQLite::Database&>> result;
  in_transaction(pool, Access::read, [&](SQLite::Database& database) { result.emplace(use(database)); });
  return *std::move(result);
}

/// What use(database) returns, once it is committed.
template <typename Use>
auto write(ConnectionPool& pool, Use use) {
  std::optional<std::invoke_result_t<Use, SQLite::Database&>> result;
  in_transaction(pool, Access::write, [&](SQLite::Database& database) { result.emplace(use(database)); });
  return *std::move(result);
}

}  // namespace spherematch
