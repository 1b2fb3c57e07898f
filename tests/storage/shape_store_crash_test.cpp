// A process killed at any moment loses nothing that it had acknowledged.
#include <SQLiteCpp/Database.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "storage/shape_store.h"
#include "tests/storage/store_file.h"

namespace spherematch {
namespace {

using testing::insert;
using testing::SampleUpload;

/// Large enough that a transaction spans many pages, and the kill mostly falls into one.
PreprocessedShape large_prepared(const SampleUpload& upload, unsigned number) {
  return testing::sample_prepared(upload.surface, number, 2000, 64);
}

/// What the child does for ever: inserts and prepares shapes, one byte down the pipe for each step that was acknowledged.
[[noreturn]] void write_until_killed(const std::filesystem::path& file, unsigned first, int acknowledge) {
  ShapeStore store(file);
  const char byte = 0;
  for (unsigned number = first;; ++number) {
    const SampleUpload upload(number);
    if (insert(store, upload) != InsertOutcome::inserted || write(acknowledge, &byte, 1) != 1) _exit(1);
    if (!store.mark_processing(upload.content.id) || write(acknowledge, &byte, 1) != 1) _exit(1);
    if (!store.save_prepared(upload.content.id, large_prepared(upload, number)) || write(acknowledge, &byte, 1) != 1) _exit(1);
  }
}

/// Kills such a child some time after its first acknowledgement; how many steps it acknowledged.
unsigned acknowledged_steps(const std::filesystem::path& file, unsigned first, std::chrono::microseconds delay) {
  int ends[2];
  if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) write_until_killed(file, first, ends[1]);
  close(ends[1]);
  char bytes[256];
  auto steps = read(ends[0], bytes, sizeof bytes);
  std::this_thread::sleep_for(delay);
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the child ended by itself";
  for (auto more = steps; more > 0; steps += more) more = read(ends[0], bytes, sizeof bytes);
  close(ends[0]);
  return static_cast<unsigned>(steps);
}

TEST(KilledProcess, LosesNothingThatItAcknowledged) {
  const testing::StoreFile file;
  std::mt19937 random(11);
  unsigned numbers = 0;
  for (int round = 0; round < 12; ++round) {
    const unsigned first = numbers;
    const unsigned steps = acknowledged_steps(file.path(), first, std::chrono::microseconds(random() % 40'000));
    ASSERT_GT(steps, 0U);

    SQLite::Database database(file.path().string());
    EXPECT_EQ(database.execAndGet("PRAGMA integrity_check").getString(), "ok");
    EXPECT_EQ(database.execAndGet("SELECT count(*) FROM pragma_foreign_key_check").getInt(), 0);

    const ShapeStore store(file.path());
    for (unsigned step = 0; step < steps; ++step) {
      const SampleUpload upload(first + step / 3);
      const auto record = store.find(upload.content.id);
      ASSERT_TRUE(record) << "an acknowledged insert is gone";
      if (step % 3 == 1) {
        EXPECT_NE(record->state, ShapeState::queued);
      }
      if (step % 3 == 2) {
        EXPECT_EQ(record->state, ShapeState::ready);
      }
    }
    // Of the step that was under way, all or nothing.
    for (const ShapeRecord& record : store.list(1'000'000).shapes) {
      if (record.state == ShapeState::ready) {
        EXPECT_NO_THROW((void)store.load_prepared(record.id));
      }
      EXPECT_NO_THROW((void)store.load_upload(record.id));
      EXPECT_NO_THROW((void)store.load_surface(record.id));
    }
    numbers = first + steps / 3 + 2;
  }
  ShapeStore store(file.path());
  const auto unfinished = store.requeue_unfinished();
  for (const std::string& id : unfinished) EXPECT_TRUE(store.mark_processing(id));
}

}  // namespace
}  // namespace spherematch
