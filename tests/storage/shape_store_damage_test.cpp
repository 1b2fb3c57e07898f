// What the store says about a damaged file, a stuck lock and a full disk, and that it goes on working afterwards.
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>

#include "storage/blob_codec.h"
#include "storage/blob_frame.h"
#include "storage/shape_store.h"
#include "tests/storage/store_file.h"

namespace spherematch {
namespace {

using testing::error_of;
using testing::insert;
using testing::SampleUpload;
using testing::StoreFile;

class DamagedStore : public ::testing::Test {
 protected:
  DamagedStore() {
    insert(store_, upload_);
    store_.save_prepared(id(), prepared_);
  }

  [[nodiscard]] const std::string& id() const { return upload_.content.id; }

  void change_blob(BlobKind kind, const std::string& new_data) {
    SQLite::Database database(file_.path().string(), SQLite::OPEN_READWRITE);
    const std::string kind_number = std::to_string(static_cast<int>(kind));
    ASSERT_EQ(database.exec("UPDATE blobs SET data = " + new_data + " WHERE kind = " + kind_number), 1);
  }

  SampleUpload upload_{1};
  PreprocessedShape prepared_ = testing::sample_prepared(upload_.surface);
  StoreFile file_;
  ShapeStore store_{file_.path()};
};

TEST_F(DamagedStore, NamesADamagedBlobAndPreparesAgain) {
  for (const BlobKind kind : {BlobKind::sphere, BlobKind::signals, BlobKind::eigenbasis}) {
    change_blob(kind, "CAST(substr(data, 1, 30) || x'5a' || substr(data, 32) AS BLOB)");
    EXPECT_EQ(error_of([&] { (void)store_.load_prepared(id()); }), StorageErrorCode::corrupt_blob);
    EXPECT_TRUE(store_.requeue(id()));
    EXPECT_TRUE(store_.save_prepared(id(), prepared_));
    testing::expect_same(*store_.load_prepared(id()), prepared_);
  }
}

TEST_F(DamagedStore, NamesADamagedUploadAndSurface) {
  change_blob(BlobKind::upload, "x''");
  change_blob(BlobKind::surface, "CAST(substr(data, 1, length(data) - 1) AS BLOB)");
  EXPECT_EQ(error_of([&] { (void)store_.load_upload(id()); }), StorageErrorCode::corrupt_blob);
  EXPECT_EQ(error_of([&] { (void)store_.load_surface(id()); }), StorageErrorCode::corrupt_blob);
  EXPECT_EQ(error_of([&] { (void)store_.load_prepared(id()); }), StorageErrorCode::corrupt_blob);
  EXPECT_TRUE(store_.find(id()));
}

TEST_F(DamagedStore, ReadsTheOtherPartsBesideADamagedEigenbasis) {
  change_blob(BlobKind::eigenbasis, "CAST(substr(data, 1, 30) || x'5a' || substr(data, 32) AS BLOB)");
  EXPECT_EQ(error_of([&] { (void)store_.load_eigenbasis(id()); }), StorageErrorCode::corrupt_blob);
  PreprocessedShape without = prepared_;
  without.eigenvalues.resize(0);
  without.eigenvectors.resize(0, 0);
  testing::expect_same(*store_.load_prepared(id(), PreparedParts::without_eigenbasis), without);
}

TEST_F(DamagedStore, NamesPartsOfDifferentShapes) {
  const Surface larger = testing::sample_surface(20);
  const Blob sphere = encode_sphere(testing::sample_prepared(larger).sphere);
  SQLite::Database database(file_.path().string(), SQLite::OPEN_READWRITE);
  SQLite::Statement update(database, "UPDATE blobs SET data = ? WHERE kind = ?");
  update.bind(1, sphere.data(), static_cast<int>(sphere.size()));
  update.bind(2, static_cast<int>(BlobKind::sphere));
  ASSERT_EQ(update.exec(), 1);
  EXPECT_EQ(error_of([&] { (void)store_.load_prepared(id()); }), StorageErrorCode::corrupt_blob);
}

TEST_F(DamagedStore, ReadsBesideAStuckLockAndNamesItOnWriting) {
  ShapeStore impatient(file_.path(), std::chrono::milliseconds(50));
  SQLite::Database other(file_.path().string(), SQLite::OPEN_READWRITE);
  other.exec("BEGIN IMMEDIATE");
  testing::expect_same(*impatient.load_prepared(id()), prepared_);
  EXPECT_EQ(error_of([&] { insert(impatient, SampleUpload(2)); }), StorageErrorCode::busy);
  EXPECT_EQ(error_of([&] { impatient.remove(id()); }), StorageErrorCode::busy);
  other.exec("ROLLBACK");
  EXPECT_EQ(insert(impatient, SampleUpload(2)), InsertOutcome::inserted);
}

constexpr int exit_unable = 77;

/// In a child process of its own mount namespace: fills a one-megabyte file system with shapes. Exit code 0 when all went well.
int fill_small_disk(const std::filesystem::path& mount_point) {
  const int namespaces = geteuid() == 0 ? CLONE_NEWNS : CLONE_NEWNS | CLONE_NEWUSER;
  if (unshare(namespaces) != 0 || mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return exit_unable;
  if (mount("small", mount_point.c_str(), "tmpfs", 0, "size=1m") != 0) return exit_unable;
  ShapeStore store(mount_point / "store.db");
  unsigned stored = 0;
  try {
    for (; stored < 10'000; ++stored) insert(store, SampleUpload(stored));
    return 1;  // a full disk that nobody noticed
  } catch (const StorageError& error) {
    if (error.code() != StorageErrorCode::full) return 2;
  }
  if (stored == 0 || store.list(10'000).shapes.size() != stored) return 3;
  for (unsigned i = 0; i < stored; ++i) testing::expect_holds(store, SampleUpload(i));
  return ::testing::Test::HasFailure() ? 4 : 0;
}

TEST(FullDisk, IsNamedAndLosesNothing) {
  const StoreFile file;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) _exit(fill_small_disk(file.directory()));
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == exit_unable) GTEST_SKIP() << "this user may not mount a small file system";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace spherematch
