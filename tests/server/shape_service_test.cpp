#include "server/shape_service.h"

#include <sqlite3.h>

#include "server/problem.h"
#include "tests/server/test_service.h"

namespace spherematch {
namespace {

using namespace std::chrono_literals;

class ShapeServiceTest : public testing::TestService {};

api::Code refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (...) {
    return problem_of(std::current_exception()).problem().code;
  }
  ADD_FAILURE() << "nothing was thrown";
  return api::Code::internal;
}

TEST_F(ShapeServiceTest, ConcurrentUploadsOfTheSameBytesComputeOnce) {
  std::atomic<int> created = 0;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i) {
      threads.emplace_back([&] {
        const HttpResponse response = post("sphere 1");
        EXPECT_EQ(shape(response).state, api::ShapeState::ready);
        if (response.status == 201) ++created;
      });
    }
  }
  EXPECT_EQ(created, 1);
  EXPECT_EQ(engine.preparations, 1);
}

TEST_F(ShapeServiceTest, UnfinishedShapesAreTakenUpAgainAfterARestart) {
  engine.hold_preparation = true;
  const std::string running = shape(post("sphere 1", {})).id;
  const std::string queued = shape(post("sphere 2", {})).id;
  wait_for_preparations(1);
  stop();
  EXPECT_EQ(engine.cancellations, 1);
  engine.hold_preparation = false;
  start();
  for (const std::string& id : {running, queued}) {
    EXPECT_TRUE(shapes->wait_until_finished(id, ShapeService::Clock::now() + 10s));
    EXPECT_EQ(shapes->get(id).state, api::ShapeState::ready);
  }
  EXPECT_EQ(engine.preparations, 3);
}

TEST_F(ShapeServiceTest, ReadyShapesAreNotPreparedAgainAfterARestart) {
  const std::string id = ready("sphere 1");
  stop();
  start();
  EXPECT_EQ(post("sphere 1").status, 200);
  EXPECT_EQ(shapes->load(id)->sphere.rows(), 4);
  EXPECT_EQ(engine.preparations, 1);
  EXPECT_EQ(engine.reads, 1);
}

TEST_F(ShapeServiceTest, LoadedShapesAreShared) {
  const std::string id = ready("sphere 1");
  EXPECT_EQ(shapes->load(id), shapes->load(id));
  stop();
  start({.cache_bytes = 0, .read_limits = {}});
  EXPECT_NE(shapes->load(id), shapes->load(id));
}

TEST_F(ShapeServiceTest, ACacheNeverServesWhatWasRemoved) {
  const std::string id = ready("sphere 1");
  (void)shapes->load(id);
  shapes->remove(id);
  EXPECT_EQ(refusal([&] { (void)shapes->load(id); }), api::Code::not_found);
  EXPECT_EQ(refusal([&] { shapes->require_ready(id, ShapeService::Clock::now()); }), api::Code::not_found);
}

TEST_F(ShapeServiceTest, AFullQueueRefusesUploadsBeforeStoringThem) {
  stop();
  start({.workers = 1, .max_queued = 1, .read_limits = {}});
  engine.hold_preparation = true;
  post("sphere 1", {});
  wait_for_preparations(1);
  post("sphere 2", {});
  const HttpResponse third = post("sphere 3", {});
  EXPECT_EQ(problem_code(third), api::Code::overloaded);
  EXPECT_EQ(engine.reads, 2);
  EXPECT_EQ(shapes->list(10, std::nullopt).items.size(), 2U);
}

TEST_F(ShapeServiceTest, LongPollsAreBounded) {
  stop();
  start({.max_long_polls = 1, .read_limits = {}});
  engine.hold_preparation = true;
  const std::string id = shape(post("sphere 1", {})).id;
  std::jthread patient([&] { EXPECT_TRUE(shapes->wait_until_finished(id, ShapeService::Clock::now() + 20s)); });
  std::this_thread::sleep_for(50ms);
  const auto start = ShapeService::Clock::now();
  EXPECT_FALSE(shapes->wait_until_finished(id, start + 20s));
  EXPECT_LT(ShapeService::Clock::now() - start, 5s);
  engine.hold_preparation = false;
}

TEST_F(ShapeServiceTest, AnUnreadablePreparationIsMadeAgain) {
  const std::string id = ready("sphere 1");
  stop();
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((directory / "store.db").c_str(), &database), SQLITE_OK);
  // Whatever the tables are called: flip the last byte of every stored eigenbasis (kind 5 of storage/blob_frame.h).
  const char* tables = "SELECT m.name, c.name FROM sqlite_master m JOIN pragma_table_info(m.name) c WHERE m.type='table' AND c.type='BLOB'";
  std::vector<std::pair<std::string, std::string>> columns;
  sqlite3_stmt* statement = nullptr;
  ASSERT_EQ(sqlite3_prepare_v2(database, tables, -1, &statement, nullptr), SQLITE_OK);
  while (sqlite3_step(statement) == SQLITE_ROW) {
    columns.emplace_back(reinterpret_cast<const char*>(sqlite3_column_text(statement, 0)),
                         reinterpret_cast<const char*>(sqlite3_column_text(statement, 1)));
  }
  sqlite3_finalize(statement);
  int changed = 0;
  for (const auto& [table, column] : columns) {
    const std::string update = "UPDATE " + table + " SET " + column + "=CAST(substr(" + column + ",1,length(" + column +
                               ")-1)||x'7f' AS BLOB) WHERE hex(substr(" + column + ",1,4))='534D4231' AND hex(substr(" + column +
                               ",7,1))='05'";
    ASSERT_EQ(sqlite3_exec(database, update.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << update;
    changed += sqlite3_changes(database);
  }
  sqlite3_close(database);
  ASSERT_EQ(changed, 1);
  start();
  EXPECT_EQ(refusal([&] { (void)shapes->load(id); }), api::Code::shape_not_ready);
  EXPECT_NO_THROW(shapes->require_ready(id, ShapeService::Clock::now() + 10s));
  EXPECT_EQ(shapes->load(id)->sphere.rows(), 4);
  EXPECT_EQ(engine.preparations, 2);
}

}  // namespace
}  // namespace spherematch
