#include "storage/job_store.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/storage/sample_shapes.h"
#include "tests/storage/store_file.h"

namespace spherematch {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

class JobStoreTest : public ::testing::Test {
 protected:
  std::string add_shape(const std::string& bytes) {
    const ContentId content = content_id(std::as_bytes(std::span(bytes)), "repair=fill");
    shapes.insert(content, {}, std::as_bytes(std::span(bytes)), testing::sample_surface());
    return content.id;
  }
  static std::vector<std::int32_t> positions(const std::vector<JobPair>& pairs) {
    std::vector<std::int32_t> result;
    for (const JobPair& pair : pairs) result.push_back(pair.position);
    return result;
  }
  std::vector<std::string> listed(const JobFilter& filter = {}) {
    std::vector<std::string> ids;
    std::optional<std::string> cursor;
    do {
      const JobPage page = jobs.list(2, cursor, filter);
      for (const JobRecord& job : page.jobs) ids.push_back(job.id);
      cursor = page.next_cursor;
    } while (cursor);
    return ids;
  }

  testing::StoreFile file;
  ShapeStore shapes{file.path()};
  JobStore jobs{shapes};
};

TEST_F(JobStoreTest, PairsGetTheirLinesInTheOrderOfFinishing) {
  jobs.create("j", "options", {{"a", "b"}, {"b", "a"}, {"c", "c"}}, 10);
  EXPECT_EQ(jobs.find("j")->state, JobState::queued);
  EXPECT_EQ(jobs.find("j")->options, "options");
  EXPECT_EQ(jobs.find("j")->started_at, "");
  EXPECT_EQ(positions(jobs.open_pairs("j")), (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(jobs.unfinished(), std::vector<std::string>{"j"});

  jobs.mark_started("j");
  EXPECT_EQ(jobs.find("j")->state, JobState::processing);
  EXPECT_NE(jobs.find("j")->started_at, "");
  EXPECT_TRUE(jobs.finish_pair("j", 2));
  EXPECT_TRUE(jobs.finish_pair("j", 0, "not-found", "gone"));
  EXPECT_FALSE(jobs.finish_pair("j", 0));  // has its line already
  EXPECT_FALSE(jobs.finish_pair("j", 7));
  EXPECT_EQ(positions(jobs.open_pairs("j")), std::vector<std::int32_t>{1});
  EXPECT_EQ(jobs.find("j")->finished_pairs, 2);
  EXPECT_EQ(jobs.find("j")->failed_pairs, 1);
  EXPECT_EQ(jobs.find("j")->finished_at, "");

  EXPECT_TRUE(jobs.finish_pair("j", 1));
  EXPECT_EQ(jobs.find("j")->state, JobState::succeeded);
  EXPECT_NE(jobs.find("j")->finished_at, "");
  EXPECT_TRUE(jobs.unfinished().empty());
  EXPECT_EQ(positions(jobs.lines("j", 0, 10)), (std::vector<std::int32_t>{2, 0, 1}));
  EXPECT_EQ(positions(jobs.lines("j", 1, 1)), std::vector<std::int32_t>{0});
  EXPECT_EQ(jobs.lines("j", 1, 1).front().error_detail, "gone");
  EXPECT_TRUE(jobs.lines("j", 3, 10).empty());
}

TEST_F(JobStoreTest, SurvivesARestart) {
  jobs.create("j", "", {{"a", "b"}, {"b", "a"}}, 10);
  jobs.mark_started("j");
  jobs.finish_pair("j", 1);
  const ShapeStore reopened(file.path());
  const JobStore again(reopened);
  EXPECT_EQ(again.unfinished(), std::vector<std::string>{"j"});
  EXPECT_EQ(positions(again.open_pairs("j")), std::vector<std::int32_t>{0});
  EXPECT_EQ(positions(again.lines("j", 0, 10)), std::vector<std::int32_t>{1});
}

TEST_F(JobStoreTest, CancelledJobsTakeNoMoreLines) {
  jobs.create("j", "", {{"a", "b"}}, 10);
  EXPECT_FALSE(jobs.remove("j"));  // active
  EXPECT_TRUE(jobs.cancel("j"));
  EXPECT_FALSE(jobs.cancel("j"));
  EXPECT_EQ(jobs.find("j")->state, JobState::cancelled);
  EXPECT_FALSE(jobs.finish_pair("j", 0));
  EXPECT_TRUE(jobs.remove("j"));
  EXPECT_FALSE(jobs.find("j"));
  EXPECT_FALSE(jobs.remove("j"));
  EXPECT_TRUE(jobs.open_pairs("j").empty());
}

TEST_F(JobStoreTest, OldFinishedJobsAreDropped) {
  for (const char* id : {"1", "2", "3", "4"}) {
    jobs.create(id, "", {{"a", "b"}}, 2);
    if (std::string_view(id) != "2") jobs.finish_pair(id, 0);
  }
  EXPECT_TRUE(jobs.find("1"));  // one of the two newest that are finished
  jobs.create("5", "", {{"a", "b"}}, 2);
  EXPECT_FALSE(jobs.find("1"));
  EXPECT_TRUE(jobs.find("2"));  // unfinished
  EXPECT_TRUE(jobs.find("3") && jobs.find("4") && jobs.find("5"));
}

TEST_F(JobStoreTest, PreparationsAreJobsToo) {
  const std::string id = add_shape("x");
  const auto queued = jobs.find("p" + id);
  ASSERT_TRUE(queued);
  EXPECT_EQ(queued->kind, JobKind::preprocess);
  EXPECT_EQ(queued->state, JobState::queued);
  EXPECT_EQ(queued->shape, id);
  EXPECT_EQ(queued->started_at, "");
  shapes.mark_processing(id);
  EXPECT_EQ(jobs.find("p" + id)->state, JobState::processing);
  EXPECT_NE(jobs.find("p" + id)->started_at, "");
  shapes.mark_failed(id, "degenerate", "flat");
  EXPECT_EQ(jobs.find("p" + id)->state, JobState::failed);
  EXPECT_EQ(jobs.find("p" + id)->error_detail, "flat");
  EXPECT_NE(jobs.find("p" + id)->finished_at, "");
  shapes.requeue(id);
  EXPECT_EQ(jobs.find("p" + id)->finished_at, "");
  shapes.save_prepared(id, testing::sample_prepared(testing::sample_surface()));
  EXPECT_EQ(jobs.find("p" + id)->state, JobState::succeeded);
  EXPECT_NE(jobs.find("p" + id)->finished_at, "");
  shapes.remove(id);
  EXPECT_FALSE(jobs.find("p" + id));
}

TEST_F(JobStoreTest, ListsBothKindsPageByPage) {
  const std::string a = std::string("p").append(add_shape("a")), b = std::string("p").append(add_shape("b"));
  for (const char* id : {"j1", "j2", "j3"}) jobs.create(id, "", {{"a", "b"}}, 10);
  jobs.finish_pair("j2", 0);
  const std::vector<std::string> all = listed();
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()), (std::set<std::string>{a, b, "j1", "j2", "j3"}));
  EXPECT_EQ(all.size(), 5U);
  EXPECT_EQ(listed({.kind = JobKind::preprocess, .state = {}}).size(), 2U);
  EXPECT_EQ(listed({.kind = {}, .state = JobState::succeeded}), std::vector<std::string>{"j2"});
  EXPECT_EQ(listed({.kind = JobKind::match, .state = JobState::queued}).size(), 2U);
  for (const char* cursor : {"", "x", "2024_"}) {
    EXPECT_EQ(testing::error_of([&] { (void)jobs.list(2, cursor, {}); }), StorageErrorCode::invalid_cursor) << cursor;
  }
}

}  // namespace
}  // namespace spherematch
