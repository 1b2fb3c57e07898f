// What can go wrong in the store.
#pragma once

#include <stdexcept>
#include <string>

namespace spherematch {

enum class StorageErrorCode {
  not_found,        ///< no such shape, or the asked part of it is not (or no longer) stored
  invalid_cursor,   ///< a page cursor that list() did not give out
  not_a_store,      ///< the file is not a SQLite database, or another program's
  newer_schema,     ///< written by a newer release; refused untouched
  corrupt_blob,     ///< stored bytes fail their checksum or contradict themselves
  unknown_version,  ///< a blob of a codec version that this release does not read
  too_large,        ///< more than the store can keep in one blob
  busy,             ///< another process held the write lock for longer than the busy timeout
  full,             ///< no space left on the device
  io,               ///< the file cannot be created, opened, read or written, or SQLite reports it damaged
};

/// Every failure that the store reports on purpose. what() is a sentence for the operator.
class StorageError : public std::runtime_error {
 public:
  StorageError(StorageErrorCode code, const std::string& detail) : std::runtime_error(detail), code_(code) {}

  [[nodiscard]] StorageErrorCode code() const { return code_; }

 private:
  StorageErrorCode code_;
};

}  // namespace spherematch
