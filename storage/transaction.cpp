#include "storage/transaction.h"

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Transaction.h>
#include <sqlite3.h>

#include <mutex>
#include <new>
#include <string>

#include "storage/error.h"

namespace spherematch {
namespace {

[[noreturn]] void rethrow(const SQLite::Exception& error) {
  switch (error.getErrorCode()) {
    case SQLITE_NOMEM:
      throw std::bad_alloc();
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw StorageError(StorageErrorCode::busy, "the store is locked by another process");
    case SQLITE_FULL:
      throw StorageError(StorageErrorCode::full, "there is no space left for the store");
    case SQLITE_TOOBIG:
      throw StorageError(StorageErrorCode::too_large, "too large for the store");
    case SQLITE_NOTADB:
      throw StorageError(StorageErrorCode::not_a_store, "the store's file is not a database");
    default:
      throw StorageError(StorageErrorCode::io, std::string("the store cannot be used: ") + error.what());
  }
}

}  // namespace

std::shared_ptr<ConnectionPool> open_store(const std::filesystem::path& file, std::chrono::milliseconds busy_timeout) {
  try {
    return std::make_shared<ConnectionPool>(file, busy_timeout);
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() == SQLITE_NOTADB) {
      throw StorageError(StorageErrorCode::not_a_store, "\"" + file.string() + "\" is not a database");
    }
    rethrow(error);
  } catch (const std::filesystem::filesystem_error& error) {
    throw StorageError(StorageErrorCode::io, std::string("the store's directory cannot be made: ") + error.what());
  }
}

void in_transaction(ConnectionPool& pool, Access access, const std::function<void(SQLite::Database&)>& use) {
  try {
    if (access == Access::read) {
      const ConnectionPool::Lease lease = pool.lease();
      const SQLite::Transaction transaction(*lease);
      use(*lease);
    } else {
      const std::lock_guard lock(pool.write_mutex());
      const ConnectionPool::Lease lease = pool.lease();
      SQLite::Transaction transaction(*lease, SQLite::TransactionBehavior::IMMEDIATE);
      use(*lease);
      transaction.commit();
    }
  } catch (const SQLite::Exception& error) {
    rethrow(error);
  }
}

}  // namespace spherematch
