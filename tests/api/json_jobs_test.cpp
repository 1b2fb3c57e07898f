#include <gtest/gtest.h>

#include <functional>

#include "api/json.h"

namespace spherematch::api {
namespace {

MatchRequest sample_points() {
  MatchRequest request;
  request.src = "a";
  request.tgt = "b";
  request.points = {7, CornersPoint{{1, 2, 3}, {0.5, 0.25, 0.25}}, PositionPoint{{0.5, -1, 1e9}}};
  request.landmarks = {{"nose", 3}, {"left \"toe\"", PositionPoint{{1, 2, 3}}}};
  request.hints = {{1, 2}, {3, 4}};
  request.method = "paper";
  request.refine = "none";
  return request;
}

MatchRequest sample_pairs() {
  MatchRequest request;
  request.pairs = {{"a", "b"}, {"b", "c"}};
  request.fields = "vertex,bary";
  request.both = true;
  request.refine = "none";
  request.orientation = "any";
  return request;
}

PointMatch sample_point_match() {
  PointMatch match;
  match.src = "a";
  match.tgt = "b";
  match.points = {PointImage{3, {3, 4, 5}, {0.5, 0.25, 0.25}, {1, 2, 3}}, std::nullopt};
  match.landmarks = {{"nose", std::nullopt}, {"tip", PointImage{1, {1, 2, 3}, {1, 0, 0}, {0, 0, 0}}}};
  match.quality = {{"score", 0.5}};
  match.seconds = {{"total", 1}};
  match.cached = true;
  match.engine = "2";
  return match;
}

Job sample_job() {
  Job job;
  job.id = "0123";
  job.state = "processing";
  job.progress = 0.5;
  job.created_at = "2024-01-02T03:04:05Z";
  job.started_at = "2024-01-02T03:04:06Z";
  job.pairs = PairCounts{10, 4, 1};
  job.results = "/jobs/0123/results";
  return job;
}

Job sample_preparation() {
  Job job;
  job.id = "pabc";
  job.kind = "preprocess";
  job.state = "failed";
  job.created_at = "2024-01-02T03:04:05Z";
  job.shape = "abc";
  job.error.emplace();
  job.error->code = Code::degenerate;
  return job;
}

PairResult sample_result() {
  PairResult result{3, "a", "b", {}, {}};
  result.match.emplace();
  result.match->src = "a";
  result.match->tgt = "b";
  result.match->n_src = 1;
  result.match->n_tgt = 2;
  result.match->vertex = {1};
  result.match->reverse =
      ReverseMap{.n_src = 2, .n_tgt = 1, .vertex = {{0, -1}}, .corners = {}, .bary = {}, .confidence = {{0.5F, 0}}, .distortion = {}};
  result.match->orientation = "reverse";
  return result;
}

template <typename T>
T again(const T& value) {
  return from_text<T>(to_text(to_json(value)));
}

template <typename T>
std::string complaint(const T& value, const std::function<void(Json&)>& change) {
  Json json = to_json(value);
  change(json);
  try {
    (void)from_text<T>(to_text(json));
  } catch (const JsonError& error) {
    return error.what();
  }
  return "";
}

TEST(JsonJobs, RoundTrips) {
  EXPECT_EQ(again(sample_points()), sample_points());
  EXPECT_EQ(again(sample_pairs()), sample_pairs());
  EXPECT_EQ(again(sample_point_match()), sample_point_match());
  EXPECT_EQ(again(sample_job()), sample_job());
  EXPECT_EQ(again(sample_preparation()), sample_preparation());
  EXPECT_EQ(again(JobPage{{sample_job(), sample_preparation()}, "next"}), (JobPage{{sample_job(), sample_preparation()}, "next"}));
  EXPECT_EQ(again(sample_result()), sample_result());
  PairResult failed{3, "a", "b", {}, Problem{}};
  failed.error->detail = "gone";
  EXPECT_EQ(again(failed), failed);
}

TEST(JsonJobs, RequestsAreCheckedMemberByMember) {
  const auto of_points = [](const std::function<void(Json&)>& change) { return complaint(sample_points(), change); };
  const auto of_pairs = [](const std::function<void(Json&)>& change) { return complaint(sample_pairs(), change); };
  EXPECT_EQ(of_points([](Json& j) { j["point"] = 1; }), "point: is not a known member");
  EXPECT_EQ(of_points([](Json& j) { j.erase("src"); }), "src: is missing");
  EXPECT_EQ(of_points([](Json& j) {
              j.erase("points");
              j.erase("landmarks");
            }),
            "the document: must have points, landmarks or pairs");
  EXPECT_EQ(of_points([](Json& j) { j["points"][0] = "x"; }), R"(points[0]: must be a vertex number, {"corners", "bary"} or {"position"})");
  EXPECT_NE(of_points([](Json& j) { j["points"][0] = -1; }), "");
  EXPECT_NE(of_points([](Json& j) { j["points"][1]["bary"][0] = -0.5; }), "");
  EXPECT_NE(of_points([](Json& j) { j["points"][1]["bary"][0] = 0.6; }), "");
  EXPECT_EQ(of_points([](Json& j) { j["points"][2]["corners"] = 1; }), "points[2].corners: is not a known member");
  EXPECT_EQ(of_points([](Json& j) { j["landmarks"]["nose"] = nullptr; }).find("landmarks.nose: "), 0U);
  EXPECT_EQ(of_points([](Json& j) { j["landmarks"] = Json::array(); }), "landmarks: must be an object of points by name");
  EXPECT_EQ(of_points([](Json& j) { j["hints"][1] = {1, 2, 3}; }), "hints[1]: must have 2 elements");
  EXPECT_EQ(of_pairs([](Json& j) { j["pairs"] = Json::array(); }), "pairs: must have 1 to 1000 elements");
  EXPECT_EQ(of_pairs([](Json& j) { j["pairs"][1][0] = 3; }), "pairs[1]: must be two shape ids");
  EXPECT_EQ(of_pairs([](Json& j) { j["hints"] = Json::array(); }), "hints: is not a known member");
  Json many = Json::array();
  for (std::size_t i = 0; i <= max_pairs; ++i) many.push_back({"a", "b"});
  EXPECT_EQ(of_pairs([&](Json& j) { j["pairs"] = many; }), "pairs: must have 1 to 1000 elements");
}

TEST(JsonJobs, EveryMemberOfAJobIsRequired) {
  const Json json = to_json(sample_job());
  for (const auto& [name, value] : json.items()) {
    EXPECT_EQ(complaint(sample_job(), [&name = name](Json& j) { j.erase(name); }), name + ": is missing");
  }
  EXPECT_EQ(complaint(sample_job(), [](Json& j) { j["state"] = "done"; }), "state: is not a known value");
  EXPECT_EQ(complaint(sample_result(), [](Json& j) { j.erase("match"); }), "the document: must have a match or an error");
}

TEST(JsonJobs, AnObjectOfTooManyMembersIsRefusedSoon) {
  std::string text = R"({"src": "a", "tgt": "b", "landmarks": {)";
  for (int i = 0; i < 300'000; ++i) text.append("\"").append(std::to_string(i)).append("\": 1,");
  text += R"("x": 1}})";
  EXPECT_THROW((void)from_text<MatchRequest>(text), JsonError);
}

}  // namespace
}  // namespace spherematch::api
