#include "storage/shape_rows.h"

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>

#include <array>
#include <limits>
#include <utility>

namespace spherematch {
namespace {

// The order in which read_row() reads and insert_row() binds.
constexpr const char* select_shape =
    "SELECT sequence, id, name, sha256, options, state, created_at, engine, error_code, error_detail, sphere_flipped, "
    "solid_angle_defect, area_distortion, vertices, faces, filled_loops, added_vertices, added_faces, dropped_vertices, "
    "welded_vertices, split_vertices, flipped_faces, removed_faces, dropped_components, simplified, format FROM shapes ";
constexpr int first_repair_column = 15;

constexpr std::array repair_fields{
    &RepairReport::filled_loops,     &RepairReport::added_vertices,  &RepairReport::added_faces,
    &RepairReport::dropped_vertices, &RepairReport::welded_vertices, &RepairReport::split_vertices,
    &RepairReport::flipped_faces,    &RepairReport::removed_faces,   &RepairReport::dropped_components,
};

ShapeState state_from(std::string_view text) {
  for (const ShapeState state : {ShapeState::queued, ShapeState::processing, ShapeState::ready}) {
    if (text == to_string(state)) return state;
  }
  return ShapeState::failed;  // the table's CHECK admits no fifth
}

/// SQLite keeps no not-a-number: it stores NULL instead.
double real(const SQLite::Column& column) { return column.isNull() ? std::numeric_limits<double>::quiet_NaN() : column.getDouble(); }

StageSeconds read_seconds(SQLite::Database& database, Sequence shape) {
  SQLite::Statement query(database, "SELECT stage, seconds FROM stage_seconds WHERE shape = ? ORDER BY position");
  query.bind(1, shape);
  StageSeconds seconds;
  while (query.executeStep()) seconds.emplace_back(query.getColumn(0).getString(), query.getColumn(1).getDouble());
  return seconds;
}

std::vector<std::string> read_tags(SQLite::Database& database, Sequence shape) {
  SQLite::Statement query(database, "SELECT tag FROM shape_tags WHERE shape = ? ORDER BY tag");
  query.bind(1, shape);
  std::vector<std::string> tags;
  while (query.executeStep()) tags.push_back(query.getColumn(0).getString());
  return tags;
}

ShapeRow read_row(SQLite::Database& database, SQLite::Statement& query) {
  ShapeRow row;
  ShapeRecord& record = row.record;
  row.sequence = query.getColumn(0).getInt64();
  record.id = query.getColumn(1).getString();
  record.name = query.getColumn(2).getString();
  record.sha256 = query.getColumn(3).getString();
  record.options = query.getColumn(4).getString();
  record.state = state_from(query.getColumn(5).getString());
  record.created_at = query.getColumn(6).getString();
  record.engine = query.getColumn(7).getString();
  record.error_code = query.getColumn(8).getString();
  record.error_detail = query.getColumn(9).getString();
  if (!query.getColumn(10).isNull()) {
    record.sphere = SphereQuality{query.getColumn(10).getInt(), real(query.getColumn(11)), real(query.getColumn(12))};
  }
  record.vertices = query.getColumn(13).getInt();
  record.faces = query.getColumn(14).getInt();
  int column = first_repair_column;
  for (const auto field : repair_fields) record.repair.*field = query.getColumn(column++).getInt();
  if (!query.getColumn(column).isNull()) record.simplified = query.getColumn(column).getInt();
  record.format = query.getColumn(column + 1).getString();
  record.seconds = read_seconds(database, row.sequence);
  record.tags = read_tags(database, row.sequence);
  return row;
}

void bind_surface(SQLite::Statement& statement, int first, const Surface& surface) {
  statement.bind(first++, surface.uploaded_vertices());
  statement.bind(first++, surface.uploaded_faces);
  for (const auto field : repair_fields) statement.bind(first++, surface.report.*field);
  if (surface.decimated) {
    statement.bind(first, static_cast<std::int32_t>(surface.decimated->mesh.vertex_count()));
  } else {
    statement.bind(first);  // NULL
  }
}

void forget_seconds(SQLite::Database& database, Sequence shape) {
  SQLite::Statement forget(database, "DELETE FROM stage_seconds WHERE shape = ?");
  forget.bind(1, shape);
  forget.exec();
}

void write_seconds(SQLite::Database& database, Sequence shape, const StageSeconds& seconds) {
  forget_seconds(database, shape);
  SQLite::Statement insert(database, "INSERT INTO stage_seconds (shape, position, stage, seconds) VALUES (?, ?, ?, ?)");
  int position = 0;
  for (const auto& [stage, duration] : seconds) {
    insert.bind(1, shape);
    insert.bind(2, position++);
    insert.bind(3, stage);
    insert.bind(4, duration);
    insert.exec();
    insert.reset();
  }
}

}  // namespace

std::optional<ShapeRow> find_row(SQLite::Database& database, std::string_view id) {
  SQLite::Statement query(database, std::string(select_shape) + "WHERE id = ?");
  query.bind(1, std::string(id));
  if (!query.executeStep()) return std::nullopt;
  return read_row(database, query);
}

std::vector<ShapeRow> rows_before(SQLite::Database& database, Sequence before, std::int64_t limit, const ShapeFilter& filter) {
  std::string sql = std::string(select_shape) + "WHERE sequence < ?";
  std::vector<std::string> values;
  const auto require = [&](const char* condition, std::string value) {
    sql += condition;
    values.push_back(std::move(value));
  };
  if (filter.state) require(" AND state = ?", std::string(to_string(*filter.state)));
  if (!filter.tag.empty()) require(" AND sequence IN (SELECT shape FROM shape_tags WHERE tag = ?)", filter.tag);
  if (!filter.name_part.empty()) require(" AND instr(lower(name), lower(?)) > 0", filter.name_part);
  if (!filter.sha256.empty()) require(" AND sha256 = ?", filter.sha256);
  SQLite::Statement query(database, sql + " ORDER BY sequence DESC LIMIT ?");
  int index = 1;
  query.bind(index++, before);
  for (const std::string& value : values) query.bind(index++, value);
  query.bind(index, limit);
  std::vector<ShapeRow> rows;
  while (query.executeStep()) rows.push_back(read_row(database, query));
  return rows;
}

Sequence insert_row(SQLite::Database& database, const ContentId& content, const ShapeLabels& labels, const Surface& surface) {
  SQLite::Statement insert(database,
                           "INSERT INTO shapes (id, name, sha256, options, state, created_at, vertices, faces, filled_loops, "
                           "added_vertices, added_faces, dropped_vertices, welded_vertices, split_vertices, flipped_faces, "
                           "removed_faces, dropped_components, simplified, format) VALUES "
                           "(?, ?, ?, ?, 'queued', strftime('%Y-%m-%dT%H:%M:%fZ', 'now'), ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(1, content.id);
  insert.bind(2, labels.name);
  insert.bind(3, content.sha256);
  insert.bind(4, content.options);
  bind_surface(insert, 5, surface);
  insert.bind(17, labels.format);
  insert.exec();
  const Sequence shape = database.getLastInsertRowid();
  write_tags(database, shape, labels.tags);
  return shape;
}

void update_name(SQLite::Database& database, Sequence shape, const std::string& name) {
  SQLite::Statement update(database, "UPDATE shapes SET name = ? WHERE sequence = ?");
  update.bind(1, name);
  update.bind(2, shape);
  update.exec();
}

void write_tags(SQLite::Database& database, Sequence shape, const std::vector<std::string>& tags) {
  SQLite::Statement forget(database, "DELETE FROM shape_tags WHERE shape = ?");
  forget.bind(1, shape);
  forget.exec();
  SQLite::Statement insert(database, "INSERT OR IGNORE INTO shape_tags (shape, tag) VALUES (?, ?)");
  for (const std::string& tag : tags) {
    insert.bind(1, shape);
    insert.bind(2, tag);
    insert.exec();
    insert.reset();
  }
}

void update_surface(SQLite::Database& database, Sequence shape, const Surface& surface) {
  SQLite::Statement update(database,
                           "UPDATE shapes SET vertices = ?, faces = ?, filled_loops = ?, added_vertices = ?, added_faces = ?, "
                           "dropped_vertices = ?, welded_vertices = ?, split_vertices = ?, flipped_faces = ?, removed_faces = ?, "
                           "dropped_components = ?, simplified = ? WHERE sequence = ?");
  bind_surface(update, 1, surface);
  update.bind(13, shape);
  update.exec();
}

void update_prepared(SQLite::Database& database, Sequence shape, const PreprocessedShape& prepared) {
  SQLite::Statement update(database,
                           "UPDATE shapes SET state = 'ready', engine = ?, sphere_flipped = ?, solid_angle_defect = ?, "
                           "area_distortion = ?, error_code = '', error_detail = '', attempts = 0, "
                           "finished_at = strftime('%Y-%m-%dT%H:%M:%fZ', 'now') WHERE sequence = ?");
  update.bind(1, prepared.engine);
  update.bind(2, prepared.sphere_quality.flipped);
  update.bind(3, prepared.sphere_quality.solid_angle_defect);
  update.bind(4, prepared.sphere_quality.area_distortion);
  update.bind(5, shape);
  update.exec();
  write_seconds(database, shape, prepared.seconds);
}

void clear_prepared(SQLite::Database& database, Sequence shape) {
  SQLite::Statement update(database,
                           "UPDATE shapes SET state = 'queued', engine = '', sphere_flipped = NULL, solid_angle_defect = NULL, "
                           "area_distortion = NULL, error_code = '', error_detail = '', attempts = 0, started_at = NULL, "
                           "finished_at = NULL WHERE sequence = ?");
  update.bind(1, shape);
  update.exec();
  forget_seconds(database, shape);
  SQLite::Statement forget(database, "DELETE FROM blobs WHERE shape = ? AND kind IN (?, ?, ?)");
  forget.bind(1, shape);
  int index = 2;
  for (const BlobKind kind : {BlobKind::sphere, BlobKind::signals, BlobKind::eigenbasis}) forget.bind(index++, static_cast<int>(kind));
  forget.exec();
}

void write_blob(SQLite::Database& database, Sequence shape, BlobKind kind, BlobView blob) {
  SQLite::Statement insert(database,
                           "INSERT INTO blobs (shape, kind, data) VALUES (?, ?, ?) "
                           "ON CONFLICT (shape, kind) DO UPDATE SET data = excluded.data");
  insert.bind(1, shape);
  insert.bind(2, static_cast<int>(kind));
  insert.bindNoCopy(3, blob.data(), static_cast<int>(blob.size()));  // at most max_blob_size
  insert.exec();
}

void read_blob(SQLite::Database& database, Sequence shape, BlobKind kind, const std::function<void(BlobView)>& use) {
  SQLite::Statement query(database, "SELECT data FROM blobs WHERE shape = ? AND kind = ?");
  query.bind(1, shape);
  query.bind(2, static_cast<int>(kind));
  if (!query.executeStep()) throw StorageError(StorageErrorCode::not_found, "the asked part of the shape is not stored");
  const SQLite::Column column = query.getColumn(0);
  const auto* bytes = static_cast<const std::byte*>(column.getBlob());
  use({bytes, static_cast<std::size_t>(column.getBytes())});
}

}  // namespace spherematch
