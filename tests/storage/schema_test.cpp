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
