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
    for (int i = 0; i < 16; ++i) {
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

TEST_F(ShapeServiceTest, ALostPreparationIsTriedAgain) {
  engine.lose_next = 2;
  EXPECT_EQ(shape(post("sphere 1")).state, api::ShapeState::ready);
  EXPECT_EQ(engine.preparations, 3);
}

TEST_F(ShapeServiceTest, AThirdLossIsAFailureWithItsReason) {
  engine.lose_next = 3;
  const api::Shape lost = shape(post("sphere 1"));
  EXPECT_EQ(lost.state, api::ShapeState::failed);
  ASSERT_TRUE(lost.error);
  EXPECT_EQ(lost.error->code, api::Code::internal);
  EXPECT_NE(lost.error->detail.find("signal 11"), std::string::npos);
  EXPECT_EQ(engine.preparations, 3);
  stop();
  start();
  EXPECT_EQ(shapes->get(lost.id).state, api::ShapeState::failed);
  // Who uploads it again starts from the beginning.
  engine.lose_next = 2;
  const HttpResponse again = post("sphere 1");
  EXPECT_EQ(again.status, 201);
  EXPECT_EQ(engine.preparations, 6);
}

TEST_F(ShapeServiceTest, LossesAreCountedAcrossRestartsAndRestartsAreNone) {
  engine.lose_next = 2;
  engine.hold_preparation = true;
  const std::string id = shape(post("sphere 1", {})).id;
  wait_for_preparations(3);
  for (int restart = 0; restart < 4; ++restart) {
    stop();
    start();
    wait_for_preparations(4 + restart);
    EXPECT_EQ(shapes->get(id).state, api::ShapeState::processing);
  }
  stop();
  engine.lose_next = 1;
  start();
  EXPECT_TRUE(shapes->wait_until_finished(id, ShapeService::Clock::now() + 10s));
  EXPECT_EQ(shapes->get(id).state, api::ShapeState::failed);
}

TEST_F(ShapeServiceTest, WantOfMemoryIsAFailureOnlyWhenItLasts) {
  engine.no_memory = true;
  const api::Shape poor = shape(post("sphere 1"));
  EXPECT_EQ(poor.state, api::ShapeState::failed);
  ASSERT_TRUE(poor.error);
  EXPECT_EQ(poor.error->code, api::Code::overloaded);
  EXPECT_EQ(engine.preparations, 3);
  engine.no_memory = false;
  EXPECT_EQ(post("sphere 1").status, 201);
}

TEST_F(ShapeServiceTest, WhatEndedAServerDoesNotKeepTheNextFromTheOthers) {
  engine.hold_preparation = true;
  const std::string first = shape(post("sphere 1", {})).id;
  const std::string second = shape(post("sphere 2", {})).id;
  wait_for_preparations(1);
  stop();
  start();
  wait_for_preparations(2);
  EXPECT_EQ(shapes->get(second).state, api::ShapeState::processing);
  EXPECT_EQ(shapes->get(first).state, api::ShapeState::queued);
  engine.hold_preparation = false;
  EXPECT_TRUE(shapes->wait_until_finished(first, ShapeService::Clock::now() + 10s));
  EXPECT_EQ(shapes->get(first).state, api::ShapeState::ready);
}

TEST_F(ShapeServiceTest, UploadsAndRemovalsAtOnceLeaveNoShapeWithoutAJob) {
  std::atomic<bool> done = false;
  {
    std::jthread remover([&] {
      while (!done) {
        for (const api::Shape& item : shapes->list(10, std::nullopt).items) (void)remove(item.id);
      }
    });
    std::vector<std::jthread> posters;
    for (int i = 0; i < 4; ++i) {
      posters.emplace_back([&] {
        for (int round = 0; round < 100; ++round) {
          const int status = post("sphere 1", {}).status;
          EXPECT_TRUE(status < 300 || status == 404) << status;  // 404: removed before its answer was made
        }
      });
    }
    posters.clear();
    done = true;
  }
  // Whatever the last of them left is ready, or becomes it without being asked.
  for (const api::Shape& item : shapes->list(10, std::nullopt).items) {
    const auto deadline = ShapeService::Clock::now() + 10s;
    while (shapes->get(item.id).state != api::ShapeState::ready && ShapeService::Clock::now() < deadline) std::this_thread::sleep_for(1ms);
    EXPECT_EQ(shapes->get(item.id).state, api::ShapeState::ready);
  }
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

TEST_F(ShapeServiceTest, AFullQueueLeavesAFailedShapeAsItIs) {
  stop();
  start({.workers = 1, .max_queued = 1, .read_limits = {}});
  const std::string id = shape(post("sphere hopeless")).id;
  engine.hold_preparation = true;
  post("sphere 1", {});
  wait_for_preparations(2);
  post("sphere 2", {});
  EXPECT_EQ(problem_code(post("sphere hopeless")), api::Code::overloaded);
  EXPECT_EQ(shapes->get(id).state, api::ShapeState::failed);
  // A known one needs no place of its own.
  EXPECT_EQ(post("sphere 2", {}).status, 200);
  engine.hold_preparation = false;
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
  EXPECT_EQ(shapes->load(id)->sphere.rows(), 4) << "what does not need the eigenbasis does not read it";
  EXPECT_EQ(refusal([&] { (void)shapes->load(id, PreparedParts::all); }), api::Code::shape_not_ready);
  EXPECT_NO_THROW(shapes->require_ready(id, ShapeService::Clock::now() + 10s));
  EXPECT_EQ(shapes->load(id, PreparedParts::all)->sphere.rows(), 4);
  EXPECT_EQ(engine.preparations, 2);
}

}  // namespace
}  // namespace spherematch
