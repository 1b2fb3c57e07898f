#include "server/match_service.h"

#include <sqlite3.h>

#include <latch>

#include "server/problem.h"

#include "tests/server/test_service.h"

namespace spherematch {
namespace {

class MatchServiceTest : public testing::TestService {
 protected:
  MatchAnswer get(MatchService::Cache cache = MatchService::Cache::use) { return match_service->get({src, tgt, {}}, cache); }

  std::string src = ready("sphere a");
  std::string tgt = ready("sphere b");
};

TEST_F(MatchServiceTest, ARepeatedMatchIsReadNotComputed) {
  EXPECT_EQ(get().source, MatchSource::computed);
  EXPECT_EQ(get().source, MatchSource::memory);
  EXPECT_EQ(engine.matches, 1);
  EXPECT_GT(match_service->memory_bytes(), 0U);

  stop();  // what was answered is stored by then
  start();
  EXPECT_GT(match_service->store_bytes(), 0U);
  EXPECT_EQ(get().source, MatchSource::store);
  EXPECT_EQ(get().source, MatchSource::memory);
  EXPECT_EQ(get().result->map.vertex, (std::vector<std::int32_t>{1, 2, 3, 0, -1}));
  EXPECT_EQ(engine.matches, 1);
}

TEST_F(MatchServiceTest, EverythingThatDeterminesAResultIsInTheKey) {
  MatchQuery query{src, tgt, {}};
  std::set<std::string> keys{match_service->key_of(query)};
  query.parameters.both = true;
  keys.insert(match_service->key_of(query));
  query.parameters.hints = {{1, 2}};
  keys.insert(match_service->key_of(query));
  query.parameters.orientation = Orientation::any;
  keys.insert(match_service->key_of(query));
  std::swap(query.src, query.tgt);
  keys.insert(match_service->key_of(query));
  engine.version_text = "stub-2";
  keys.insert(match_service->key_of(query));
  EXPECT_EQ(keys.size(), 6U);
}

TEST_F(MatchServiceTest, BypassingTheCacheKeepsNothing) {
  EXPECT_EQ(get(MatchService::Cache::bypass).source, MatchSource::computed);
  EXPECT_EQ(match_service->memory_bytes() + match_service->store_bytes(), 0U);
  (void)get();
  EXPECT_EQ(get(MatchService::Cache::bypass).source, MatchSource::computed);
  EXPECT_EQ(engine.matches, 3);
}

TEST_F(MatchServiceTest, ConcurrentRequestsComputeOnce) {
  engine.hold_matches = true;
  std::atomic<int> joined = 0;
  {
    std::vector<std::jthread> clients;
    std::latch started(8);
    for (int i = 0; i < 8; ++i) {
      clients.emplace_back([&] {
        started.count_down();
        if (get().source == MatchSource::joined) ++joined;
      });
    }
    started.wait();
    while (engine.matches < 1) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    engine.hold_matches = false;
  }
  EXPECT_EQ(engine.matches, 1);
  EXPECT_GT(joined, 0);
}

TEST_F(MatchServiceTest, WhoJoinsSharesTheFailureToo) {
  engine.hold_matches = true;
  std::jthread first([this] { EXPECT_THROW((void)get(), EngineError); });
  while (engine.matches < 1) std::this_thread::yield();
  std::jthread second([this] { EXPECT_THROW((void)get(), EngineError); });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  stop_source.request_stop();
  first.join();
  second.join();
  EXPECT_EQ(engine.matches, 1);
}

TEST_F(MatchServiceTest, BeyondItsBoundNobodyJoins) {
  stop();
  match_settings.max_joined = 0;
  start();
  engine.hold_matches = true;
  std::jthread first([this] { (void)get(); });
  while (engine.matches < 1) std::this_thread::yield();
  try {
    (void)get();
    ADD_FAILURE() << "was not turned away";
  } catch (const ProblemError& error) {
    EXPECT_EQ(error.problem().code, api::Code::overloaded);
  }
  engine.hold_matches = false;
}

TEST_F(MatchServiceTest, WhatNeedsNoComputationHasRoomWhereNothingElseHas) {
  const MatchQuery known{src, tgt, {}};
  const MatchQuery other{tgt, src, {}};
  const MatchQuery under_way{src, src, {}};
  using Cache = MatchService::Cache;
  (void)get();
  EXPECT_NO_THROW(match_service->require_room(other, Cache::bypass));

  engine.hold_matches = true;
  std::jthread first([&] { (void)match_service->get(under_way); });
  while (engine.matches < 2) std::this_thread::yield();
  EXPECT_NO_THROW(match_service->require_room(other, Cache::bypass)) << "one may wait";
  std::jthread second([&] { (void)match_service->get(known, Cache::bypass); });
  while (matches->counts().waiting < 1) std::this_thread::yield();

  EXPECT_THROW(match_service->require_room(other, Cache::use), ProblemError);
  EXPECT_THROW(match_service->require_room(known, Cache::bypass), ProblemError);
  EXPECT_NO_THROW(match_service->require_room(known, Cache::use));
  EXPECT_NO_THROW(match_service->require_room(under_way, Cache::use));
  engine.hold_matches = false;
}

TEST_F(MatchServiceTest, BackgroundWorkLetsOthersPass) {
  engine.hold_matches = true;
  std::jthread first([this] { (void)get(); });
  while (engine.matches < 1) std::this_thread::yield();
  std::vector<std::string> order;
  std::mutex mutex;
  const auto done = [&](const char* who) {
    const std::lock_guard lock(mutex);
    order.emplace_back(who);
  };
  std::jthread behind([&] {
    (void)match_service->get({tgt, tgt, {}}, MatchService::Cache::use, MatchService::Urgency::background);
    done("background");
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::jthread before([&] {
    (void)match_service->get({tgt, src, {}});
    done("interactive");
  });
  while (matches->counts().waiting < 1) std::this_thread::yield();
  engine.hold_matches = false;
  behind.join();
  before.join();
  EXPECT_EQ(order, (std::vector<std::string>{"interactive", "background"}));
}

TEST_F(MatchServiceTest, WhatIsGivenUpEndsAndCanBeAskedForAgain) {
  for (const auto cache : {MatchService::Cache::use, MatchService::Cache::bypass}) {
    engine.hold_matches = true;
    engine.matches = 0;
    std::stop_source given_up;
    std::jthread first([&] {
      EXPECT_THROW((void)match_service->get({src, tgt, {}}, cache, MatchService::Urgency::interactive, given_up.get_token()), EngineError);
    });
    while (engine.matches < 1) std::this_thread::yield();
    given_up.request_stop();
    first.join();
    EXPECT_THROW((void)match_service->get({src, tgt, {}}, cache, MatchService::Urgency::interactive, given_up.get_token()), EngineError);
    EXPECT_EQ(engine.matches, 1);  // given up before it began
    engine.hold_matches = false;
    EXPECT_EQ(get(cache).source, MatchSource::computed);
  }
}

TEST_F(MatchServiceTest, WhatIsGivenUpGoesOnForThoseWhoJoined) {
  engine.hold_matches = true;
  std::stop_source given_up;
  std::jthread first([&] {
    EXPECT_NO_THROW(
        (void)match_service->get({src, tgt, {}}, MatchService::Cache::use, MatchService::Urgency::interactive, given_up.get_token()));
  });
  while (engine.matches < 1) std::this_thread::yield();
  std::jthread second([this] { EXPECT_EQ(get().source, MatchSource::joined); });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  given_up.request_stop();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  engine.hold_matches = false;
  first.join();
  second.join();
  EXPECT_EQ(engine.matches, 1);
}

TEST_F(MatchServiceTest, RemovedShapesTakeTheirResultsAlong) {
  (void)get();
  (void)match_service->get({tgt, tgt, {}});
  const std::size_t both = match_service->memory_bytes();
  EXPECT_EQ(remove(src).status, 204);
  EXPECT_EQ(match_service->memory_bytes(), both / 2);
  EXPECT_THROW((void)match_service->get({src, tgt, {}}), ProblemError);
}

TEST_F(MatchServiceTest, WhatIsForgottenIsNotFoundAmongTheUnsavedEither) {
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open((directory / "store.db").c_str(), &other), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);  // nobody else can save
  EXPECT_EQ(get().source, MatchSource::computed);
  EXPECT_EQ(get().source, MatchSource::memory);
  match_service->forget(tgt);
  EXPECT_EQ(get().source, MatchSource::computed);
  sqlite3_close(other);
}

TEST_F(MatchServiceTest, AResultThatComesAfterItsShapeWasRemovedIsNotKept) {
  for (const auto urgency : {MatchService::Urgency::interactive, MatchService::Urgency::background}) {
    const std::string removed = ready("sphere c");
    const MatchQuery query{src, removed, {}};
    const int before = engine.matches;
    engine.hold_matches = true;
    std::jthread first([&] { EXPECT_TRUE(match_service->get(query, MatchService::Cache::use, urgency).result); });
    while (engine.matches == before) std::this_thread::yield();
    EXPECT_EQ(remove(removed).status, 204);
    engine.hold_matches = false;
    first.join();
    EXPECT_EQ(match_service->memory_bytes(), 0U);
    EXPECT_THROW((void)match_service->get(query), ProblemError);
  }
}

TEST_F(MatchServiceTest, EveryAnswerIsObserved) {
  stop();
  std::vector<MatchSource> seen;
  match_settings.observe = [&seen](MatchSource source, double seconds) {
    EXPECT_GE(seconds, 0);
    seen.push_back(source);
  };
  start();
  (void)get();
  (void)get();
  EXPECT_EQ(seen, (std::vector<MatchSource>{MatchSource::computed, MatchSource::memory}));
}

}  // namespace
}  // namespace spherematch
