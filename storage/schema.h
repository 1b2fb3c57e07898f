// The tables of the store, and how a file of an older release becomes one of this release.
#pragma once

#include <chrono>

#include "storage/sqlite_forward.h"

namespace spherematch {

/// Counted by PRAGMA user_version; a new version appends a step in schema.cpp and changes none before it.
[[nodiscard]] int schema_version();

/// Makes the tables in an empty file, or brings an older schema up to date, in one transaction. Processes that open the same
/// file at once wait for each other, for up to
/// `busy_timeout`. On an error the file is as it was.
/// @throws StorageError(not_a_store, newer_schema), SQLite::Exception
void migrate(SQLite::Database& database, std::chrono::milliseconds busy_timeout);

}  // namespace spherematch
