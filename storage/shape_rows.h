// Rows of the store's tables to and from the types of storage/shape_store.h. Each function works inside its caller's
// transaction and throws SQLite::Exception.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "storage/blob_codec.h"
#include "storage/blob_frame.h"
#include "storage/shape_store.h"
#include "storage/sqlite_forward.h"

namespace spherematch {

/// A shape's place in the order of insertion; what the other tables refer to.
using Sequence = std::int64_t;

struct ShapeRow {
  Sequence sequence = 0;
  ShapeRecord record;
};

[[nodiscard]] std::optional<ShapeRow> find_row(SQLite::Database& database, std::string_view id);
/// At most `limit` rows below `before` that the filter lets pass, newest first.
[[nodiscard]] std::vector<ShapeRow> rows_before(SQLite::Database& database, Sequence before, std::int64_t limit, const ShapeFilter& filter);

/// A new queued shape.
Sequence insert_row(SQLite::Database& database, const ContentId& content, const ShapeLabels& labels, const Surface& surface);
void update_name(SQLite::Database& database, Sequence shape, const std::string& name);
/// These take the place of the tags that the shape has.
void write_tags(SQLite::Database& database, Sequence shape, const std::vector<std::string>& tags);
/// Counts and repair report of a surface that takes the place of another.
void update_surface(SQLite::Database& database, Sequence shape, const Surface& surface);
/// The shape becomes ready.
void update_prepared(SQLite::Database& database, Sequence shape, const PreprocessedShape& prepared);
/// The shape becomes queued; what was prepared, and an error, are forgotten.
void clear_prepared(SQLite::Database& database, Sequence shape);

void write_blob(SQLite::Database& database, Sequence shape, BlobKind kind, BlobView blob);

/// Calls `use` on the stored bytes, which live during the call only.
/// @throws StorageError(not_found)
void read_blob(SQLite::Database& database, Sequence shape, BlobKind kind, const std::function<void(BlobView)>& use);

}  // namespace spherematch
