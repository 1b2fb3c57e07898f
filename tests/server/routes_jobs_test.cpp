#include "tests/server/test_service.h"

namespace spherematch {
namespace {

class RoutesJobs : public testing::TestService {
 protected:
  std::string a = ready("sphere a");
  std::string b = ready("sphere b");

  static api::Job job(const HttpResponse& response) { return api::from_text<api::Job>(response.body); }
  HttpResponse create(const std::vector<std::array<std::string, 2>>& pairs, const std::string& fields = "vertex") {
    api::MatchRequest request;
    request.pairs = pairs;
    request.fields = fields;
    return post_json("/match", api::to_text(api::to_json(request)));
  }
  HttpResponse results(const std::string& id, const std::multimap<std::string, std::string>& query = {}) {
    return get("/jobs/" + id + "/results", query);
  }
  static std::vector<api::PairResult> lines_of(HttpResponse response) {
    EXPECT_EQ(response.status, 200) << response.body;
    EXPECT_EQ(response.content_type, "application/x-ndjson");
    std::string text;
    while (const auto piece = response.stream()) text += *piece;
    std::vector<api::PairResult> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(api::from_text<api::PairResult>(line));
    return lines;
  }
};

TEST_F(RoutesJobs, ManyPairsAreAJobWithALineForEach) {
  const HttpResponse created = create({{a, b}, {b, a}, {a, a}}, "vertex,bary");
  ASSERT_EQ(created.status, 202) << created.body;
  const std::string id = job(created).id;
  EXPECT_EQ(header(created, "Location"), "/jobs/" + id);
  EXPECT_EQ(job(created).kind, "match");
  EXPECT_EQ(job(created).results, "/jobs/" + id + "/results");

  const auto lines = lines_of(results(id));
  ASSERT_EQ(lines.size(), 3U);
  std::set<std::int32_t> indices;
  for (const api::PairResult& line : lines) {
    indices.insert(line.index);
    ASSERT_TRUE(line.match);
    EXPECT_EQ(line.match->src, line.src);
    EXPECT_TRUE(line.match->vertex && line.match->bary && !line.match->corners);
  }
  EXPECT_EQ(indices, (std::set<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(lines[0].src, a);
  EXPECT_EQ(lines[0].tgt, b);

  const api::Job ended = job(get("/jobs/" + id, {{"wait", "10"}}));
  EXPECT_EQ(ended.state, "succeeded");
  EXPECT_EQ(ended.progress, 1);
  EXPECT_EQ(ended.pairs, (api::PairCounts{3, 3, 0}));
  EXPECT_NE(ended.finished_at, "");
  EXPECT_EQ(lines_of(results(id, {{"after", "2"}})).size(), 1U);
  EXPECT_EQ(engine.matches, 3);
}

TEST_F(RoutesJobs, LinesComeAsPairsFinish) {
  engine.hold_matches = true;
  const std::string id = job(create({{a, b}, {b, a}})).id;
  while (engine.matches < 1) std::this_thread::yield();
  EXPECT_TRUE(lines_of(results(id, {{"wait", "0"}})).empty());
  const api::Job running = job(get("/jobs/" + id));
  EXPECT_EQ(running.state, "processing");
  EXPECT_EQ(running.progress, 0);
  EXPECT_EQ(header(get("/jobs/" + id), "Retry-After"), "1");
  EXPECT_EQ(job(create({{a, a}})).position, 1);
  engine.hold_matches = false;
  EXPECT_EQ(lines_of(results(id)).size(), 2U);
}

TEST_F(RoutesJobs, AJobGoesOnAfterARestartAndComputesNothingTwice) {
  const std::string id = job(create({{a, b}, {b, a}, {a, a}, {b, b}})).id;
  match_jobs->wait_for_line(id, 1, std::chrono::steady_clock::now() + std::chrono::seconds(10));
  stop();
  const int before = engine.matches;
  start();
  EXPECT_EQ(lines_of(results(id)).size(), 4U);
  EXPECT_EQ(engine.matches, 4) << before << " before the restart";
  EXPECT_EQ(job(get("/jobs/" + id)).pairs, (api::PairCounts{4, 4, 0}));
}

TEST_F(RoutesJobs, APairThatFailsHasItsReason) {
  engine.hold_matches = true;
  const std::string id = job(create({{a, a}, {b, a}})).id;
  while (engine.matches < 1) std::this_thread::yield();
  remove(b);
  engine.hold_matches = false;
  const auto lines = lines_of(results(id));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(lines[0].match);
  EXPECT_EQ(lines[1].error->code, api::Code::not_found);
  EXPECT_EQ(job(get("/jobs/" + id)).pairs, (api::PairCounts{2, 1, 1}));
  EXPECT_EQ(job(get("/jobs/" + id)).state, "succeeded");
}

TEST_F(RoutesJobs, PairsWaitForTheirShapes) {
  engine.hold_preparation = true;
  const std::string late = shape(post("sphere late", {})).id;
  const std::string hopeless = shape(post("sphere hopeless", {})).id;
  const std::string id = job(create({{late, a}, {hopeless, a}, {a, b}})).id;
  match_jobs->wait_for_line(id, 0, std::chrono::steady_clock::now() + std::chrono::seconds(10));
  EXPECT_EQ(job(get("/jobs/" + id)).pairs, (api::PairCounts{3, 1, 0}));
  engine.hold_preparation = false;
  EXPECT_EQ(lines_of(results(id)).size(), 3U);
  EXPECT_EQ(job(get("/jobs/" + id)).pairs, (api::PairCounts{3, 2, 1}));
}

TEST_F(RoutesJobs, MatchJobsAreCancelledAndForgotten) {
  engine.hold_matches = true;
  const std::string id = job(create({{a, b}, {b, a}})).id;
  while (engine.matches < 1) std::this_thread::yield();
  const auto drop = [&](const std::string& job_id) {
    return call({.method = "DELETE", .path = "/jobs/" + job_id, .query = {}, .body = {}, .file_name = {}, .headers = {}});
  };
  const HttpResponse cancelled = drop(id);
  EXPECT_EQ(cancelled.status, 202);
  EXPECT_EQ(job(cancelled).state, "cancelled");
  while (matches->counts().inside > 0) std::this_thread::yield();  // the match under way ends although it is held
  engine.hold_matches = false;
  EXPECT_EQ(lines_of(results(id)).size(), 0U);
  EXPECT_EQ(drop(id).status, 204);
  EXPECT_EQ(problem_code(drop(id)), api::Code::not_found);
  EXPECT_EQ(problem_code(results(id)), api::Code::not_found);
  EXPECT_EQ(engine.matches, 1);
}

TEST_F(RoutesJobs, PreparationsAreJobs) {
  const api::Job done = job(get("/jobs/p" + a));
  EXPECT_EQ(done.kind, "preprocess");
  EXPECT_EQ(done.state, "succeeded");
  EXPECT_EQ(done.shape, a);
  EXPECT_EQ(done.progress, 1);
  EXPECT_FALSE(done.pairs);
  EXPECT_EQ(problem_code(results("p" + a)), api::Code::not_found);

  engine.hold_preparation = true;
  const std::string first = shape(post("sphere first", {})).id;
  const std::string second = shape(post("sphere second", {})).id;
  const std::string third = shape(post("sphere third", {})).id;
  wait_for_preparations(3);
  EXPECT_EQ(job(get("/jobs/p" + first)).state, "processing");
  EXPECT_EQ(job(get("/jobs/p" + first)).stage, "conformal");
  EXPECT_EQ(job(get("/jobs/p" + second)).state, "queued");
  EXPECT_EQ(job(get("/jobs/p" + third)).position, 1);
  const auto drop = [&](const std::string& id) {
    return call({.method = "DELETE", .path = "/jobs/p" + id, .query = {}, .body = {}, .file_name = {}, .headers = {}});
  };
  EXPECT_EQ(job(drop(first)).state, "cancelled");
  EXPECT_EQ(shape(get("/shapes/" + first)).state, api::ShapeState::failed);
  EXPECT_EQ(shape(get("/shapes/" + first)).error->code, api::Code::cancelled);
  EXPECT_EQ(problem_code(drop(first)), api::Code::job_finished);
  EXPECT_EQ(problem_code(drop(a)), api::Code::job_finished);
  engine.hold_preparation = false;
  EXPECT_EQ(job(get("/jobs/p" + second, {{"wait", "10"}})).state, "succeeded");
  EXPECT_EQ(post("sphere first").status, 201);  // tries again
}

TEST_F(RoutesJobs, ListsAndFilters) {
  const std::string id = job(create({{a, b}})).id;
  (void)lines_of(results(id));
  match_jobs->wait(id, std::chrono::steady_clock::now() + std::chrono::seconds(10));
  const auto listed = [&](std::multimap<std::string, std::string> query) {
    return api::from_text<api::JobPage>(get("/jobs", query).body).items;
  };
  EXPECT_EQ(listed({}).size(), 3U);
  ASSERT_EQ(listed({{"kind", "match"}}).size(), 1U);
  EXPECT_EQ(listed({{"kind", "match"}})[0].id, id);
  EXPECT_EQ(listed({{"state", "succeeded"}, {"kind", "preprocess"}}).size(), 2U);
  EXPECT_TRUE(listed({{"state", "failed"}}).empty());
  const HttpResponse page = get("/jobs", {{"limit", "2"}, {"state", "succeeded"}});
  const std::string link = header(page, "Link");
  EXPECT_NE(link.find("state=succeeded"), std::string::npos) << link;
  const auto cursor = api::from_text<api::JobPage>(page.body).next_cursor;
  ASSERT_TRUE(cursor);
  EXPECT_EQ(listed({{"cursor", *cursor}}).size(), 1U);
  EXPECT_EQ(problem_code(get("/jobs", {{"state", "done"}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(get("/jobs", {{"cursor", "x"}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(get("/jobs/nothing")), api::Code::not_found);
}

TEST_F(RoutesJobs, WhatIsNoJobIsRefused) {
  EXPECT_EQ(problem_code(post_json("/match", "{")), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(post_json("/match", R"({"pairs": []})")), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(post_json("/match", R"({"pairs": [["x"]]})")), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(create({{a, std::string(32, '0')}})), api::Code::not_found);
  EXPECT_EQ(problem_code(create({{a, b}}, "faces")), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(post_json("/match", R"({"pairs": [[")" + a + R"(", ")" + b + R"("]], "method": "best"})")),
            api::Code::invalid_parameter);
  stop();
  job_settings.max_active = 0;
  start();
  EXPECT_EQ(problem_code(create({{a, b}})), api::Code::overloaded);
}

TEST_F(RoutesJobs, PointsAndLandmarksOfOnePair) {
  const auto ask = [&](const std::string& rest) {
    return post_json("/match", R"({"src": ")" + a + R"(", "tgt": ")" + b + "\", " + rest + "}");
  };
  const HttpResponse response = ask(R"("points": [0, 4, {"corners": [0, 1, 2], "bary": [0, 1, 0]}],
                                       "landmarks": {"nose": 1, "tip": {"position": [2, 2, 2]}})");
  ASSERT_EQ(response.status, 200) << response.body;
  const auto match = api::from_text<api::PointMatch>(response.body);
  ASSERT_EQ(match.points->size(), 3U);
  // Vertex 0 goes to 0.5 v1 + 0.3 v0 + 0.2 v1 of the tetrahedron.
  EXPECT_EQ(match.points->at(0)->vertex, 1);
  EXPECT_NEAR(match.points->at(0)->position[1], -0.4, 1e-6);
  EXPECT_FALSE(match.points->at(1));  // dropped
  EXPECT_EQ(match.points->at(2)->vertex, 2);
  EXPECT_EQ(match.landmarks->at(0).first, "nose");
  EXPECT_EQ(match.landmarks->at(0).second->vertex, 2);
  EXPECT_EQ(match.landmarks->at(1).second->vertex, 1);  // nearest to vertex 0
  EXPECT_FALSE(match.cached);
  EXPECT_TRUE(api::from_text<api::PointMatch>(ask(R"("points": [0])").body).cached);
  EXPECT_EQ(engine.matches, 1);

  EXPECT_EQ(problem_code(ask(R"("points": [5])")), api::Code::invalid_parameter);
  EXPECT_NE(ask(R"("points": [0, 5])").body.find("points[1]"), std::string::npos);
  EXPECT_EQ(problem_code(ask(R"("points": [-1])")), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(ask(R"("points": [{"corners": [0, 1, 2], "bary": [1, 1, 0]}])")), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(ask(R"("landmarks": {"x": {"corners": [0, 1, 9], "bary": [0, 0, 1]}})")), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(ask(R"("method": "default")")), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(ask(R"("points": [0], "pairs": [["x", "y"]])")), api::Code::invalid_parameter);
}

}  // namespace
}  // namespace spherematch
