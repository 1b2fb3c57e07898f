#include "storage/schema.h"

#include <SQLiteCpp/Database.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <thread>

#include "storage/shape_store.h"
#include "tests/storage/store_file.h"

namespace spherematch {
namespace {

using testing::error_of;
using testing::StoreFile;

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

StorageErrorCode open_error(const std::filesystem::path& path) {
  return error_of([&] { const ShapeStore store(path); });
}

int pragma(const std::filesystem::path& path, const std::string& name) {
  SQLite::Database database(path.string());
  return database.execAndGet("PRAGMA " + name).getInt();
}

TEST(Schema, MakesAMissingFileAndItsDirectories) {
  const StoreFile file;
  const auto path = file.directory() / "deep" / "er" / "store.db";
  const ShapeStore store(path);
  EXPECT_TRUE(store.list(10).shapes.empty());
  EXPECT_EQ(pragma(path, "user_version"), schema_version());
  SQLite::Database database(path.string());
  EXPECT_EQ(database.execAndGet("PRAGMA journal_mode").getString(), "wal");
}

TEST(Schema, MigratesAnEmptyFile) {
  const StoreFile file;
  write(file.path(), "");
  ShapeStore store(file.path());
  EXPECT_EQ(testing::insert(store, testing::SampleUpload(1)), InsertOutcome::inserted);
  EXPECT_EQ(pragma(file.path(), "user_version"), schema_version());
}

TEST(Schema, OpensItsOwnFileAgain) {
  const StoreFile file;
  const testing::SampleUpload upload(1);
  {
    ShapeStore store(file.path());
    testing::insert(store, upload);
  }
  const ShapeStore store(file.path());
  testing::expect_holds(store, upload);
}

/// The file as the first release wrote it, with a ready, a processing and a failed shape.
void make_first_schema(const std::filesystem::path& path) {
  SQLite::Database database(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  database.exec("PRAGMA page_size = 16384");
  database.exec("PRAGMA journal_mode = WAL");
  database.exec(R"sql(
CREATE TABLE shapes (
  sequence INTEGER PRIMARY KEY AUTOINCREMENT, id TEXT NOT NULL UNIQUE, name TEXT NOT NULL, sha256 TEXT NOT NULL, options TEXT NOT NULL,
  state TEXT NOT NULL CHECK (state IN ('queued', 'processing', 'ready', 'failed')), vertices INTEGER NOT NULL, faces INTEGER NOT NULL,
  filled_loops INTEGER NOT NULL, added_vertices INTEGER NOT NULL, added_faces INTEGER NOT NULL, dropped_vertices INTEGER NOT NULL,
  welded_vertices INTEGER NOT NULL, split_vertices INTEGER NOT NULL, flipped_faces INTEGER NOT NULL, removed_faces INTEGER NOT NULL,
  dropped_components INTEGER NOT NULL, sphere_flipped INTEGER, solid_angle_defect REAL, area_distortion REAL,
  engine TEXT NOT NULL DEFAULT '', error_code TEXT NOT NULL DEFAULT '', error_detail TEXT NOT NULL DEFAULT '', created_at TEXT NOT NULL
) STRICT;
CREATE INDEX shapes_unfinished ON shapes (sequence) WHERE state IN ('queued', 'processing');
CREATE TABLE stage_seconds (
  shape INTEGER NOT NULL REFERENCES shapes (sequence) ON DELETE CASCADE, position INTEGER NOT NULL, stage TEXT NOT NULL,
  seconds REAL NOT NULL, PRIMARY KEY (shape, position)
) STRICT, WITHOUT ROWID;
CREATE TABLE blobs (
  shape INTEGER NOT NULL REFERENCES shapes (sequence) ON DELETE CASCADE, kind INTEGER NOT NULL, data BLOB NOT NULL, UNIQUE (shape, kind)
) STRICT;
INSERT INTO shapes VALUES
  (1, 'a', 'one.STL', 'f', 'repair=fill', 'ready', 12, 20, 1, 2, 3, 4, 5, 6, 7, 8, 9, 0, 1e-14, 0.5, '1', '', '', '2024-01-31T12:00:00.000Z'),
  (2, 'b', 'two.gltf', 'f', 'repair=none', 'processing', 9, 9, 0, 0, 0, 0, 0, 0, 0, 0, 0, NULL, NULL, NULL, '', '', '',
    '2024-01-31T12:00:01.000Z'),
  (5, 'c', '', 'f', 'repair=fill', 'failed', 9, 9, 0, 0, 0, 0, 0, 0, 0, 0, 0, NULL, NULL, NULL, '', 'x', 'y', '2024-01-31T12:00:02.000Z');
INSERT INTO stage_seconds VALUES (1, 0, 'conformal', 1.5), (1, 1, 'total', 2.5);
PRAGMA application_id = 1399875661;
PRAGMA user_version = 1;
)sql");
}

TEST(Schema, BringsAFileOfTheFirstReleaseUpToDate) {
  const StoreFile file;
  make_first_schema(file.path());
  ShapeStore store(file.path());
  EXPECT_EQ(pragma(file.path(), "user_version"), schema_version());
  const auto ready = store.find("a");
  ASSERT_TRUE(ready);
  EXPECT_EQ(ready->name, "one.STL");
  EXPECT_EQ(ready->state, ShapeState::ready);
  EXPECT_EQ(ready->format, "stl");
  EXPECT_TRUE(ready->tags.empty());
  EXPECT_EQ(store.find("b")->format, "gltf");
  EXPECT_EQ(store.find("c")->format, "");
  EXPECT_EQ(store.change("c", {.name = {}, .tags = std::vector<std::string>{"old"}}), ChangeOutcome::changed);
  EXPECT_EQ(store.list(9, std::nullopt, {.state = {}, .tag = "old", .name_part = {}, .sha256 = {}}).shapes.size(), 1U);
  EXPECT_EQ(ready->repair, (RepairReport{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(ready->simplified, std::nullopt);
  EXPECT_EQ(ready->seconds, (StageSeconds{{"conformal", 1.5}, {"total", 2.5}}));
  EXPECT_EQ(ready->created_at, "2024-01-31T12:00:00.000Z");
  EXPECT_EQ(store.find("c")->error_detail, "y");
  EXPECT_EQ(store.requeue_unfinished(), std::vector<std::string>{"b"});
  EXPECT_EQ(store.count_lost_attempt("b"), 1);
  // Places in the order are still never used twice.
  testing::insert(store, testing::SampleUpload(1));
  EXPECT_EQ(store.list(1).next_cursor, "6");
}

TEST(Schema, RefusesANewerVersionUntouched) {
  const StoreFile file;
  { const ShapeStore store(file.path()); }
  {
    SQLite::Database database(file.path().string(), SQLite::OPEN_READWRITE);
    database.exec("PRAGMA user_version = " + std::to_string(schema_version() + 1));
  }
  const std::string before = contents(file.path());
  EXPECT_EQ(open_error(file.path()), StorageErrorCode::newer_schema);
  EXPECT_EQ(contents(file.path()), before);
}

TEST(Schema, RefusesOtherProgramsDatabasesUntouched) {
  for (const char* statement : {"CREATE TABLE theirs (x)", "PRAGMA user_version = 1", "PRAGMA application_id = 7"}) {
    const StoreFile file;
    {
      SQLite::Database database(file.path().string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
      database.exec(statement);
    }
    const std::string before = contents(file.path());
    EXPECT_EQ(open_error(file.path()), StorageErrorCode::not_a_store) << statement;
    EXPECT_EQ(contents(file.path()), before) << statement;
  }
}

TEST(Schema, RefusesWhatIsNoDatabase) {
  const StoreFile file;
  const std::string text(5000, 'x');
  write(file.path(), text);
  EXPECT_EQ(open_error(file.path()), StorageErrorCode::not_a_store);
  EXPECT_EQ(contents(file.path()), text);
}

TEST(Schema, SaysThatAFileCannotBeOpened) {
  const StoreFile file;
  EXPECT_EQ(open_error(file.directory()), StorageErrorCode::io);
  write(file.path(), "");
  EXPECT_EQ(open_error(file.path() / "below-a-file.db"), StorageErrorCode::io);
}

TEST(Schema, ManyMayMakeTheSameFileAtOnce) {
  for (int round = 0; round < 10; ++round) {
    const StoreFile file;
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < 8; ++i) {
      threads.emplace_back([&, i] {
        EXPECT_NO_THROW({
          ShapeStore store(file.path());
          testing::insert(store, testing::SampleUpload(i));
        });
      });
    }
    threads.clear();
    EXPECT_EQ(ShapeStore(file.path()).list(100).shapes.size(), 8U);
  }
}

}  // namespace
}  // namespace spherematch
