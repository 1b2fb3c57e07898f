#include "storage/shape_store.h"

#include <SQLiteCpp/Database.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/storage/store_file.h"

namespace spherematch {
namespace {

using testing::error_of;
using testing::expect_holds;
using testing::insert;
using testing::sample_prepared;
using testing::SampleUpload;

class ShapeStoreTest : public ::testing::Test {
 protected:
  int count(const std::string& table) {
    SQLite::Database database(file_.path().string());
    return database.execAndGet("SELECT count(*) FROM " + table).getInt();
  }

  testing::StoreFile file_;
  ShapeStore store_{file_.path()};
};

TEST_F(ShapeStoreTest, KeepsAnUpload) {
  const SampleUpload upload(7);
  EXPECT_EQ(insert(store_, upload, "cat"), InsertOutcome::inserted);
  const auto record = store_.find(upload.content.id);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->id, upload.content.id);
  EXPECT_EQ(record->name, "cat");
  EXPECT_EQ(record->sha256, upload.content.sha256);
  EXPECT_EQ(record->options, "repair=fill");
  EXPECT_EQ(record->state, ShapeState::queued);
  EXPECT_EQ(record->vertices, upload.surface.uploaded_vertices());
  EXPECT_EQ(record->faces, upload.surface.uploaded_faces);
  EXPECT_EQ(record->repair, upload.surface.report);
  EXPECT_FALSE(record->sphere);
  EXPECT_TRUE(record->seconds.empty());
  EXPECT_EQ(record->engine + record->error_code + record->error_detail, "");
  std::string form = record->created_at;
  std::replace_if(
      form.begin(), form.end(), [](char c) { return c >= '0' && c <= '9'; }, 'd');
  EXPECT_EQ(form, "dddd-dd-ddTdd:dd:dd.dddZ");
  expect_holds(store_, upload);
}

TEST_F(ShapeStoreTest, KeepsADecimatedCopy) {
  const SampleUpload plain(7);
  SampleUpload coarse(8);
  coarse.surface.decimated = testing::sample_decimated(coarse.surface);
  insert(store_, plain, "plain");
  insert(store_, coarse, "coarse");
  EXPECT_EQ(store_.find(plain.content.id)->simplified, std::nullopt);
  EXPECT_EQ(store_.find(coarse.content.id)->simplified, coarse.surface.decimated->mesh.vertex_count());
  testing::expect_same(store_.load_surface(coarse.content.id), coarse.surface);

  // A preparation speaks of the copy, and may replace it.
  PreprocessedShape shape = sample_prepared(coarse.surface);
  shape.surface.decimated.reset();
  ASSERT_TRUE(store_.save_prepared(coarse.content.id, shape));
  EXPECT_EQ(store_.find(coarse.content.id)->simplified, std::nullopt);
  shape = sample_prepared(coarse.surface);
  EXPECT_EQ(shape.sphere.rows(), coarse.surface.decimated->mesh.vertex_count());
  ASSERT_TRUE(store_.save_prepared(coarse.content.id, shape));
  EXPECT_EQ(store_.find(coarse.content.id)->simplified, coarse.surface.decimated->mesh.vertex_count());
  testing::expect_same(*store_.load_prepared(coarse.content.id), shape);
}

TEST_F(ShapeStoreTest, ReadsThePartsApart) {
  const SampleUpload upload(1);
  insert(store_, upload);
  const std::string& id = upload.content.id;
  EXPECT_EQ(error_of([&] { (void)store_.load_prepared(id, PreparedParts::without_eigenbasis); }), StorageErrorCode::not_found);
  EXPECT_EQ(error_of([&] { (void)store_.load_eigenbasis(id); }), StorageErrorCode::not_found);

  const PreprocessedShape shape = sample_prepared(upload.surface);
  ASSERT_TRUE(store_.save_prepared(id, shape));
  const StoredEigenbasis basis = store_.load_eigenbasis(id);
  PreprocessedShape assembled = *store_.load_prepared(id, PreparedParts::without_eigenbasis);
  EXPECT_EQ(assembled.eigenvalues.size() + assembled.eigenvectors.size(), 0);
  assembled.eigenvalues = basis.eigenvalues;
  assembled.eigenvectors = basis.eigenvectors;
  testing::expect_same(assembled, shape);
}

TEST_F(ShapeStoreTest, KeepsAnyName) {
  using namespace std::string_literals;
  const std::string name = "'; DROP TABLE shapes; -- \0 \xff \xf0\x9f\x90\x88"s;
  insert(store_, SampleUpload(1), name);
  EXPECT_EQ(store_.find(SampleUpload(1).content.id)->name, name);
}

TEST_F(ShapeStoreTest, InsertIsIdempotent) {
  const SampleUpload upload(1);
  insert(store_, upload, "first");
  store_.mark_processing(upload.content.id);
  EXPECT_EQ(insert(store_, upload, "second"), InsertOutcome::known);
  EXPECT_EQ(store_.find(upload.content.id)->name, "first");
  EXPECT_EQ(store_.find(upload.content.id)->state, ShapeState::processing);
  ASSERT_TRUE(store_.save_prepared(upload.content.id, sample_prepared(upload.surface)));
  EXPECT_EQ(insert(store_, upload), InsertOutcome::known);
  EXPECT_EQ(store_.find(upload.content.id)->state, ShapeState::ready);
  EXPECT_EQ(count("shapes"), 1);
}

TEST_F(ShapeStoreTest, AFailedShapeInsertedAgainIsQueuedAgain) {
  const SampleUpload upload(1);
  insert(store_, upload, "first");
  store_.mark_processing(upload.content.id);
  EXPECT_TRUE(store_.mark_failed(upload.content.id, "parametrization-failed", "no luck"));
  auto record = store_.find(upload.content.id);
  EXPECT_EQ(record->state, ShapeState::failed);
  EXPECT_EQ(record->error_code, "parametrization-failed");
  EXPECT_EQ(record->error_detail, "no luck");
  EXPECT_EQ(insert(store_, upload, "second"), InsertOutcome::queued_again);
  record = store_.find(upload.content.id);
  EXPECT_EQ(record->state, ShapeState::queued);
  EXPECT_EQ(record->name, "first");
  EXPECT_EQ(record->error_code + record->error_detail, "");
  expect_holds(store_, upload);
}

TEST_F(ShapeStoreTest, KeepsWhatWasPrepared) {
  const SampleUpload upload(1);
  const std::string& id = upload.content.id;
  insert(store_, upload);
  store_.mark_processing(id);
  const PreprocessedShape prepared = sample_prepared(upload.surface, 9);
  EXPECT_TRUE(store_.save_prepared(id, prepared));
  testing::expect_same(*store_.load_prepared(id), prepared);
  const auto record = store_.find(id);
  EXPECT_EQ(record->state, ShapeState::ready);
  EXPECT_EQ(record->engine, "engine-9");
  EXPECT_EQ(record->seconds, prepared.seconds);
  EXPECT_EQ(record->repair, prepared.surface.report);
  ASSERT_TRUE(record->sphere);
  EXPECT_EQ(record->sphere->flipped, 9);
  EXPECT_EQ(record->sphere->area_distortion, prepared.sphere_quality.area_distortion);

  const PreprocessedShape newer = sample_prepared(upload.surface, 10);  // saving again replaces
  EXPECT_TRUE(store_.save_prepared(id, newer));
  testing::expect_same(*store_.load_prepared(id), newer);
  EXPECT_EQ(count("blobs"), 5);

  const ShapeStore reopened(file_.path());
  testing::expect_same(*reopened.load_prepared(id), newer);
}

TEST_F(ShapeStoreTest, KeepsNotANumberInAQuality) {
  const SampleUpload upload(1);
  insert(store_, upload);
  PreprocessedShape prepared = sample_prepared(upload.surface);
  prepared.sphere_quality.area_distortion = std::numeric_limits<double>::quiet_NaN();
  store_.save_prepared(upload.content.id, prepared);
  EXPECT_TRUE(std::isnan(store_.load_prepared(upload.content.id)->sphere_quality.area_distortion));
}

TEST_F(ShapeStoreTest, AnswersForWhatIsNotThere) {
  const SampleUpload upload(1);
  const std::string& id = upload.content.id;
  EXPECT_FALSE(store_.find(id));
  EXPECT_FALSE(store_.remove(id));
  EXPECT_FALSE(store_.mark_processing(id));
  EXPECT_FALSE(store_.mark_failed(id, "a", "b"));
  EXPECT_FALSE(store_.save_prepared(id, sample_prepared(upload.surface)));
  EXPECT_FALSE(store_.requeue(id));
  EXPECT_FALSE(store_.requeue_outdated(id, "any"));
  EXPECT_EQ(error_of([&] { (void)store_.load_upload(id); }), StorageErrorCode::not_found);
  EXPECT_EQ(error_of([&] { (void)store_.load_surface(id); }), StorageErrorCode::not_found);
  EXPECT_EQ(error_of([&] { (void)store_.load_prepared(id); }), StorageErrorCode::not_found);
  insert(store_, upload);
  EXPECT_EQ(error_of([&] { (void)store_.load_prepared(id); }), StorageErrorCode::not_found);  // not yet prepared
  EXPECT_EQ(count("blobs"), 2);
}

TEST_F(ShapeStoreTest, RemoveLeavesNothing) {
  const SampleUpload kept(1);
  const SampleUpload removed(2);
  for (const SampleUpload& upload : {kept, removed}) {
    insert(store_, upload);
    store_.save_prepared(upload.content.id, sample_prepared(upload.surface));
  }
  EXPECT_EQ(count("blobs"), 10);
  EXPECT_TRUE(store_.remove(removed.content.id));
  EXPECT_FALSE(store_.find(removed.content.id));
  EXPECT_EQ(count("shapes"), 1);
  EXPECT_EQ(count("blobs"), 5);
  EXPECT_EQ(count("stage_seconds"), 3);
  EXPECT_FALSE(store_.save_prepared(removed.content.id, sample_prepared(removed.surface)));  // a worker that comes late
  EXPECT_EQ(count("blobs"), 5);
  expect_holds(store_, kept);
  EXPECT_EQ(insert(store_, removed), InsertOutcome::inserted);
}

TEST_F(ShapeStoreTest, StatesFollowEachOther) {
  const SampleUpload upload(1);
  const std::string& id = upload.content.id;
  insert(store_, upload);
  EXPECT_FALSE(store_.requeue(id));  // is queued
  EXPECT_TRUE(store_.mark_processing(id));
  EXPECT_FALSE(store_.mark_processing(id));  // another worker has it
  EXPECT_FALSE(store_.requeue(id));
  EXPECT_TRUE(store_.save_prepared(id, sample_prepared(upload.surface)));
  EXPECT_FALSE(store_.mark_processing(id));
  EXPECT_FALSE(store_.mark_failed(id, "late", "another worker made it"));
  EXPECT_EQ(store_.find(id)->state, ShapeState::ready);
  EXPECT_TRUE(store_.requeue(id));
  EXPECT_EQ(count("blobs"), 2);
  EXPECT_EQ(count("stage_seconds"), 0);
  EXPECT_FALSE(store_.find(id)->sphere);
  EXPECT_TRUE(store_.mark_failed(id, "code", "detail"));
  EXPECT_FALSE(store_.mark_processing(id));
  EXPECT_TRUE(store_.requeue(id));
  EXPECT_EQ(store_.find(id)->state, ShapeState::queued);
}

TEST_F(ShapeStoreTest, OutdatedShapesAreQueuedAgain) {
  const SampleUpload upload(1);
  const std::string& id = upload.content.id;
  insert(store_, upload);
  EXPECT_FALSE(store_.requeue_outdated(id, "engine-2"));  // queued anyway
  store_.save_prepared(id, sample_prepared(upload.surface, 1));
  EXPECT_FALSE(store_.requeue_outdated(id, "engine-1"));
  EXPECT_EQ(store_.find(id)->state, ShapeState::ready);
  EXPECT_TRUE(store_.requeue_outdated(id, "engine-2"));
  EXPECT_EQ(store_.find(id)->state, ShapeState::queued);
  EXPECT_EQ(error_of([&] { (void)store_.load_prepared(id); }), StorageErrorCode::not_found);
  expect_holds(store_, upload);
}

TEST_F(ShapeStoreTest, UnfinishedShapesAreQueuedAgain) {
  std::vector<std::string> ids;
  for (unsigned i = 0; i < 5; ++i) {
    const SampleUpload upload(i);
    insert(store_, upload);
    ids.push_back(upload.content.id);
  }
  store_.mark_processing(ids[1]);
  store_.mark_failed(ids[2], "code", "detail");
  store_.save_prepared(ids[3], sample_prepared(SampleUpload(3).surface));
  EXPECT_EQ(store_.unfinished(), (std::vector<std::string>{ids[0], ids[1], ids[4]}));
  EXPECT_EQ(store_.find(ids[1])->state, ShapeState::processing);
  EXPECT_EQ(store_.requeue_unfinished(), (std::vector<std::string>{ids[0], ids[4], ids[1]}));
  EXPECT_EQ(store_.find(ids[1])->state, ShapeState::queued);
  EXPECT_EQ(store_.find(ids[2])->state, ShapeState::failed);
  EXPECT_EQ(store_.find(ids[3])->state, ShapeState::ready);
}

TEST_F(ShapeStoreTest, WhatWasUnderWayIsTakenUpLast) {
  std::vector<std::string> ids;
  for (unsigned i = 0; i < 4; ++i) {
    const SampleUpload upload(i);
    insert(store_, upload);
    ids.push_back(upload.content.id);
  }
  store_.mark_processing(ids[0]);
  store_.mark_processing(ids[1]);
  EXPECT_EQ(store_.count_lost_attempt(ids[1]), 1);
  EXPECT_EQ(store_.requeue_unfinished(), (std::vector<std::string>{ids[2], ids[3], ids[0], ids[1]}));
  EXPECT_EQ(store_.requeue_unfinished(), (std::vector<std::string>{ids[0], ids[2], ids[3], ids[1]}));
}

TEST_F(ShapeStoreTest, CountsLostAttemptsUntilTheShapeIsReadyOrQueuedAnew) {
  const SampleUpload upload(1);
  const std::string& id = upload.content.id;
  EXPECT_EQ(store_.count_lost_attempt(id), 0);
  insert(store_, upload);
  EXPECT_EQ(store_.count_lost_attempt(id), 1);
  store_.mark_processing(id);
  EXPECT_EQ(store_.count_lost_attempt(id), 2);
  store_.requeue_unfinished();
  EXPECT_EQ(store_.count_lost_attempt(id), 3);
  store_.mark_failed(id, "code", "detail");
  EXPECT_EQ(store_.count_lost_attempt(id), 0);
  store_.requeue(id);
  EXPECT_EQ(store_.count_lost_attempt(id), 1);
  store_.save_prepared(id, sample_prepared(upload.surface));
  store_.requeue(id);
  EXPECT_EQ(store_.count_lost_attempt(id), 1);
}

TEST_F(ShapeStoreTest, PagesFromNewestToOldest) {
  std::vector<std::string> newest_first;
  for (unsigned i = 0; i < 7; ++i) {
    const SampleUpload upload(i);
    insert(store_, upload);
    newest_first.insert(newest_first.begin(), upload.content.id);
  }
  std::vector<std::string> seen;
  std::vector<std::size_t> sizes;
  std::optional<std::string> cursor;
  do {
    const ShapePage page = store_.list(3, cursor);
    for (const ShapeRecord& record : page.shapes) seen.push_back(record.id);
    sizes.push_back(page.shapes.size());
    cursor = page.next_cursor;
  } while (cursor);
  EXPECT_EQ(seen, newest_first);
  EXPECT_EQ(sizes, (std::vector<std::size_t>{3, 3, 1}));
  EXPECT_EQ(store_.list(7).next_cursor, std::nullopt);
  EXPECT_TRUE(store_.list(6).next_cursor);
}

TEST_F(ShapeStoreTest, PagesStayRightBesideChanges) {
  std::vector<SampleUpload> uploads;
  for (unsigned i = 0; i < 6; ++i) insert(store_, uploads.emplace_back(i));
  const ShapePage first = store_.list(2);  // shapes 5 and 4
  insert(store_, SampleUpload(6));
  store_.remove(uploads[4].content.id);
  store_.remove(uploads[3].content.id);
  const ShapePage second = store_.list(2, first.next_cursor);
  ASSERT_EQ(second.shapes.size(), 2U);
  EXPECT_EQ(second.shapes[0].id, uploads[2].content.id);
  EXPECT_EQ(second.shapes[1].id, uploads[1].content.id);
}

TEST_F(ShapeStoreTest, RefusesForeignCursors) {
  for (const char* cursor : {"", "x", "-1", "0", "1x", " 1", "99999999999999999999", "1.5"}) {
    EXPECT_EQ(error_of([&] { (void)store_.list(10, cursor); }), StorageErrorCode::invalid_cursor) << cursor;
  }
}

TEST_F(ShapeStoreTest, SaysWhetherItTakesWrites) {
  const std::filesystem::path log = file_.path().string() + "-wal";
  const auto before = std::filesystem::file_size(log);
  store_.check_writable();
  EXPECT_GT(std::filesystem::file_size(log), before);  // it is not only asked for
  ShapeStore impatient(file_.path(), std::chrono::milliseconds(10));
  SQLite::Database other(file_.path().string(), SQLite::OPEN_READWRITE);
  other.exec("BEGIN IMMEDIATE");
  EXPECT_EQ(error_of([&] { impatient.check_writable(); }), StorageErrorCode::busy);
  other.exec("ROLLBACK");
  EXPECT_NO_THROW(impatient.check_writable());
}

TEST_F(ShapeStoreTest, NamesEveryState) {
  std::set<std::string_view> names;
  for (const ShapeState state : {ShapeState::queued, ShapeState::processing, ShapeState::ready, ShapeState::failed}) {
    names.insert(to_string(state));
  }
  EXPECT_EQ(names, (std::set<std::string_view>{"failed", "processing", "queued", "ready"}));
}

}  // namespace
}  // namespace spherematch
