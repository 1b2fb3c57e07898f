#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

#include "storage/shape_store.h"
#include "tests/storage/store_file.h"

namespace spherematch {
namespace {

using testing::insert;
using testing::sample_prepared;
using testing::SampleUpload;

/// Two stores on one file stand for two processes: they share nothing but the file.
class SharedFile : public ::testing::Test {
 protected:
  template <typename Work>
  void in_threads(unsigned count, Work work) {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < count; ++i) {
      threads.emplace_back([=, this] { EXPECT_NO_THROW(work(i, i % 2 == 0 ? first_ : second_)); });
    }
  }

  testing::StoreFile file_;
  ShapeStore first_{file_.path()};
  ShapeStore second_{file_.path()};
};

TEST_F(SharedFile, OneOfManyInsertsIsNew) {
  for (unsigned round = 0; round < 10; ++round) {
    const SampleUpload upload(round);
    std::atomic<int> inserted = 0;
    std::atomic<int> known = 0;
    in_threads(8, [&](unsigned, ShapeStore& store) {
      const InsertOutcome outcome = insert(store, upload);
      ++(outcome == InsertOutcome::inserted ? inserted : known);
    });
    EXPECT_EQ(inserted, 1);
    EXPECT_EQ(known, 7);
    testing::expect_holds(first_, upload);
  }
}

TEST_F(SharedFile, OneOfManyWorkersGetsAShape) {
  for (unsigned round = 0; round < 10; ++round) {
    const SampleUpload upload(round);
    insert(first_, upload);
    std::atomic<int> claimed = 0;
    in_threads(8, [&](unsigned, ShapeStore& store) { claimed += store.mark_processing(upload.content.id) ? 1 : 0; });
    EXPECT_EQ(claimed, 1);
  }
}

TEST_F(SharedFile, ManyWritersLoseNothing) {
  constexpr unsigned threads = 6;
  constexpr unsigned each = 20;
  in_threads(threads, [&](unsigned thread, ShapeStore& store) {
    for (unsigned i = 0; i < each; ++i) {
      const SampleUpload upload(thread * each + i);
      ASSERT_EQ(insert(store, upload), InsertOutcome::inserted);
      ASSERT_TRUE(store.save_prepared(upload.content.id, sample_prepared(upload.surface, i)));
    }
  });
  EXPECT_EQ(first_.list(1000).shapes.size(), threads * each);
  for (unsigned i = 0; i < threads * each; ++i) {
    const SampleUpload upload(i);
    testing::expect_same(*second_.load_prepared(upload.content.id), sample_prepared(upload.surface, i % each));
  }
}

// A reader sees a shape of one preparation in all its parts, never of two.
TEST_F(SharedFile, ReadersSeeWholeShapesDuringWrites) {
  const SampleUpload upload(1);
  const std::string& id = upload.content.id;
  insert(first_, upload);
  const std::vector<PreprocessedShape> versions{sample_prepared(upload.surface, 1), sample_prepared(upload.surface, 2)};
  first_.save_prepared(id, versions[0]);
  std::atomic<bool> done = false;
  std::jthread writer([&] {
    for (unsigned i = 1; i <= 100; ++i) first_.save_prepared(id, versions[i % 2]);
    done = true;
  });
  int reads = 0;
  while (!done || reads < 10) {
    const auto shape = reads % 2 == 0 ? first_.load_prepared(id) : second_.load_prepared(id);
    testing::expect_same(*shape, versions.at(shape->engine == "engine-1" ? 0 : 1));
    const auto record = second_.find(id);
    ASSERT_EQ(record->seconds.size(), 3U);
    EXPECT_EQ(record->sphere->flipped, record->engine == "engine-1" ? 1 : 2);
    ++reads;
  }
}

TEST_F(SharedFile, ShapesMayBeRemovedWhileTheyAreReadAndPrepared) {
  const SampleUpload upload(1);
  const std::string& id = upload.content.id;
  const PreprocessedShape prepared = sample_prepared(upload.surface);
  in_threads(4, [&](unsigned thread, ShapeStore& store) {
    for (int i = 0; i < 60; ++i) {
      if (thread == 0) insert(store, upload);
      if (thread == 1) store.save_prepared(id, prepared);
      if (thread == 2) store.remove(id);
      if (thread != 3) continue;
      try {
        testing::expect_same(*store.load_prepared(id), prepared);
      } catch (const StorageError& error) {
        EXPECT_EQ(error.code(), StorageErrorCode::not_found);
      }
    }
  });
  insert(first_, upload);
  first_.save_prepared(id, prepared);
  testing::expect_same(*second_.load_prepared(id), prepared);
}

}  // namespace
}  // namespace spherematch
