#include "storage/shape_store.h"

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Statement.h>
#include <sqlite3.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <limits>

#include "storage/blob_codec.h"
#include "storage/connection_pool.h"
#include "storage/shape_rows.h"
#include "storage/transaction.h"

namespace spherematch {
namespace {

ShapeRow existing_row(SQLite::Database& database, std::string_view id) {
  auto row = find_row(database, id);
  if (!row) throw StorageError(StorageErrorCode::not_found, "there is no shape \"" + std::string(id) + "\"");
  return *std::move(row);
}

template <typename Decode>
auto load(SQLite::Database& database, Sequence shape, BlobKind kind, Decode decode) {
  decltype(decode(BlobView{})) result;
  read_blob(database, shape, kind, [&](BlobView blob) { result = decode(blob); });
  return result;
}

ShapeRow prepared_row(SQLite::Database& database, std::string_view id) {
  ShapeRow row = existing_row(database, id);
  if (row.record.state != ShapeState::ready || !row.record.sphere) {
    throw StorageError(StorageErrorCode::not_found, "shape \"" + row.record.id + "\" is not prepared");
  }
  return row;
}

void require_same_size(const ShapeRow& row, Eigen::Index expected, Eigen::Index found) {
  if (expected == found) return;
  throw StorageError(StorageErrorCode::corrupt_blob, "the parts of shape \"" + row.record.id + "\" differ in size");
}

StoredEigenbasis load_basis(SQLite::Database& database, const ShapeRow& row) {
  StoredEigenbasis basis = load(database, row.sequence, BlobKind::eigenbasis, decode_eigenbasis);
  require_same_size(row, basis.eigenvalues.size(), basis.eigenvectors.cols());
  return basis;
}

bool requeue_where(ConnectionPool& pool, std::string_view id, const std::function<bool(const ShapeRecord&)>& wanted) {
  const auto wanted_row = [&](SQLite::Database& database) {
    auto row = find_row(database, id);
    return row && wanted(row->record) ? std::optional(row->sequence) : std::nullopt;
  };
  // Asked without the write lock first: every match asks whether its shapes are outdated, and nearly always they are not.
  if (!read(pool, wanted_row)) return false;
  return write(pool, [&](SQLite::Database& database) {
    const auto shape = wanted_row(database);
    if (shape) clear_prepared(database, *shape);
    return shape.has_value();
  });
}

std::vector<std::string> unfinished_ids(SQLite::Database& database, const char* order) {
  SQLite::Statement query(database, std::string("SELECT id FROM shapes WHERE state IN ('queued', 'processing') ORDER BY ") + order);
  std::vector<std::string> ids;
  while (query.executeStep()) ids.push_back(query.getColumn(0).getString());
  return ids;
}

Sequence parse_cursor(const std::optional<std::string>& cursor) {
  if (!cursor) return std::numeric_limits<Sequence>::max();
  Sequence before = 0;
  const char* end = cursor->data() + cursor->size();
  const auto [stop, error] = std::from_chars(cursor->data(), end, before);
  if (error != std::errc() || stop != end || before < 1) {
    throw StorageError(StorageErrorCode::invalid_cursor, "the cursor is not one that a page of shapes gave out");
  }
  return before;
}

}  // namespace

void ShapeStore::check_writable() {
  write(*pool_, [](SQLite::Database& database) {
    // Writing the version again touches the first page of the file, and so everything that a commit needs.
    const int version = database.execAndGet("PRAGMA user_version").getInt();
    database.exec("PRAGMA user_version = " + std::to_string(version));
    return true;
  });
}

std::string_view to_string(ShapeState state) {
  switch (state) {
    case ShapeState::queued:
      return "queued";
    case ShapeState::processing:
      return "processing";
    case ShapeState::ready:
      return "ready";
    case ShapeState::failed:
      break;
  }
  return "failed";
}

ShapeStore::ShapeStore(const std::filesystem::path& file, std::chrono::milliseconds busy_timeout) : pool_(open_store(file, busy_timeout)) {}

ShapeStore::~ShapeStore() = default;

InsertOutcome ShapeStore::insert(const ContentId& content, const ShapeLabels& labels, std::span<const std::byte> upload,
                                 const Surface& surface) {
  const Blob upload_blob = encode_upload(upload);
  const Blob surface_blob = encode_surface(surface);
  return write(*pool_, [&](SQLite::Database& database) {
    if (const auto known = find_row(database, content.id)) {
      if (known->record.state != ShapeState::failed) return InsertOutcome::known;
      clear_prepared(database, known->sequence);
      return InsertOutcome::queued_again;
    }
    const Sequence shape = insert_row(database, content, labels, surface);
    write_blob(database, shape, BlobKind::upload, upload_blob);
    write_blob(database, shape, BlobKind::surface, surface_blob);
    return InsertOutcome::inserted;
  });
}

std::optional<ShapeRecord> ShapeStore::find(std::string_view id) const {
  return read(*pool_, [&](SQLite::Database& database) -> std::optional<ShapeRecord> {
    auto row = find_row(database, id);
    if (!row) return std::nullopt;
    return std::move(row->record);
  });
}

ShapePage ShapeStore::list(std::size_t limit, const std::optional<std::string>& cursor, const ShapeFilter& filter) const {
  const Sequence before = parse_cursor(cursor);
  // One more than asked for tells whether a next page exists.
  const auto wanted = static_cast<std::int64_t>(std::clamp<std::size_t>(limit, 1, std::numeric_limits<std::int32_t>::max())) + 1;
  auto rows = read(*pool_, [&](SQLite::Database& database) { return rows_before(database, before, wanted, filter); });
  ShapePage page;
  if (static_cast<std::int64_t>(rows.size()) == wanted) {
    rows.pop_back();
    page.next_cursor = std::to_string(rows.back().sequence);
  }
  page.shapes.reserve(rows.size());
  for (ShapeRow& row : rows) page.shapes.push_back(std::move(row.record));
  return page;
}

ChangeOutcome ShapeStore::change(std::string_view id, const ShapeChange& change, const std::function<bool(const ShapeRecord&)>& accept) {
  return write(*pool_, [&](SQLite::Database& database) {
    const auto row = find_row(database, id);
    if (!row) return ChangeOutcome::not_found;
    if (accept && !accept(row->record)) return ChangeOutcome::refused;
    if (change.name) update_name(database, row->sequence, *change.name);
    if (change.tags) write_tags(database, row->sequence, *change.tags);
    return ChangeOutcome::changed;
  });
}

bool ShapeStore::remove(std::string_view id) {
  return write(*pool_, [&](SQLite::Database& database) {
    SQLite::Statement statement(database, "DELETE FROM shapes WHERE id = ?");  // foreign keys remove the rest
    statement.bind(1, std::string(id));
    return statement.exec() > 0;
  });
}

bool ShapeStore::mark_processing(std::string_view id) {
  return write(*pool_, [&](SQLite::Database& database) {
    SQLite::Statement statement(
        database,
        "UPDATE shapes SET state = 'processing', finished_at = NULL, started_at = strftime('%Y-%m-%dT%H:%M:%fZ', 'now') "
        "WHERE id = ? AND state = 'queued'");
    statement.bind(1, std::string(id));
    return statement.exec() > 0;
  });
}

bool ShapeStore::mark_failed(std::string_view id, std::string_view code, std::string_view detail) {
  return write(*pool_, [&](SQLite::Database& database) {
    SQLite::Statement statement(database,
                                "UPDATE shapes SET state = 'failed', error_code = ?, error_detail = ?, "
                                "finished_at = strftime('%Y-%m-%dT%H:%M:%fZ', 'now') "
                                "WHERE id = ? AND state IN ('queued', 'processing')");
    statement.bind(1, std::string(code));
    statement.bind(2, std::string(detail));
    statement.bind(3, std::string(id));
    return statement.exec() > 0;
  });
}

int ShapeStore::count_lost_attempt(std::string_view id) {
  return write(*pool_, [&](SQLite::Database& database) {
    SQLite::Statement statement(database,
                                "UPDATE shapes SET attempts = attempts + 1 WHERE id = ? AND state IN ('queued', 'processing') "
                                "RETURNING attempts");
    statement.bind(1, std::string(id));
    return statement.executeStep() ? statement.getColumn(0).getInt() : 0;
  });
}

bool ShapeStore::save_prepared(std::string_view id, const PreprocessedShape& shape) {
  const Blob surface = encode_surface(shape.surface);
  const Blob sphere = encode_sphere(shape.sphere);
  const Blob signals = encode_signals(shape.signals);
  const Blob eigenbasis = encode_eigenbasis(shape.eigenvalues, shape.eigenvectors);
  return write(*pool_, [&](SQLite::Database& database) {
    const auto row = find_row(database, id);
    if (!row) return false;
    update_surface(database, row->sequence, shape.surface);
    update_prepared(database, row->sequence, shape);
    write_blob(database, row->sequence, BlobKind::surface, surface);
    write_blob(database, row->sequence, BlobKind::sphere, sphere);
    write_blob(database, row->sequence, BlobKind::signals, signals);
    write_blob(database, row->sequence, BlobKind::eigenbasis, eigenbasis);
    return true;
  });
}

bool ShapeStore::requeue(std::string_view id) {
  return requeue_where(*pool_, id,
                       [](const ShapeRecord& record) { return record.state == ShapeState::ready || record.state == ShapeState::failed; });
}

bool ShapeStore::requeue_outdated(std::string_view id, std::string_view current_engine) {
  return requeue_where(*pool_, id,
                       [&](const ShapeRecord& record) { return record.state == ShapeState::ready && record.engine != current_engine; });
}

std::vector<std::string> ShapeStore::requeue_unfinished() {
  return write(*pool_, [](SQLite::Database& database) {
    auto ids = unfinished_ids(database, "attempts, state = 'processing', sequence");
    database.exec("UPDATE shapes SET state = 'queued' WHERE state = 'processing'");
    return ids;
  });
}

std::vector<std::string> ShapeStore::unfinished() const {
  return read(*pool_, [](SQLite::Database& database) { return unfinished_ids(database, "sequence"); });
}

std::vector<std::byte> ShapeStore::load_upload(std::string_view id) const {
  return read(*pool_, [&](SQLite::Database& database) {
    return load(database, existing_row(database, id).sequence, BlobKind::upload, decode_upload);
  });
}

Surface ShapeStore::load_surface(std::string_view id) const {
  return read(*pool_, [&](SQLite::Database& database) {
    return load(database, existing_row(database, id).sequence, BlobKind::surface, decode_surface);
  });
}

std::shared_ptr<const PreprocessedShape> ShapeStore::load_prepared(std::string_view id, PreparedParts parts) const {
  return read(*pool_, [&](SQLite::Database& database) -> std::shared_ptr<const PreprocessedShape> {
    ShapeRow row = prepared_row(database, id);
    auto shape = std::make_shared<PreprocessedShape>();
    shape->surface = load(database, row.sequence, BlobKind::surface, decode_surface);
    shape->sphere = load(database, row.sequence, BlobKind::sphere, decode_sphere);
    shape->signals = load(database, row.sequence, BlobKind::signals, decode_signals);
    const Eigen::Index vertices = shape->surface.working_mesh().vertex_count();
    require_same_size(row, vertices, shape->sphere.rows());
    if (parts == PreparedParts::all) {
      StoredEigenbasis basis = load_basis(database, row);
      require_same_size(row, vertices, basis.eigenvectors.rows());
      shape->eigenvalues = std::move(basis.eigenvalues);
      shape->eigenvectors = std::move(basis.eigenvectors);
    }
    shape->sphere_quality = *row.record.sphere;
    shape->seconds = std::move(row.record.seconds);
    shape->engine = std::move(row.record.engine);
    return shape;
  });
}

StoredEigenbasis ShapeStore::load_eigenbasis(std::string_view id) const {
  return read(*pool_, [&](SQLite::Database& database) { return load_basis(database, prepared_row(database, id)); });
}

}  // namespace spherematch
