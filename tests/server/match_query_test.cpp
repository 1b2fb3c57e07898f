#include "server/match_query.h"

#include <gtest/gtest.h>

#include "server/problem.h"

namespace spherematch {
namespace {

MatchQuery parse(std::multimap<std::string, std::string> query) {
  HttpRequest request;
  query.emplace("src", "s");
  query.emplace("tgt", "t");
  request.query = std::move(query);
  return match_query_of(RequestParameters(request, {"src", "tgt", "method", "refine", "orientation", "hints", "candidate"}));
}

TEST(MatchQuery, ReadsWhatDeterminesAMatch) {
  const MatchQuery plain = parse({});
  EXPECT_EQ(plain.src, "s");
  EXPECT_EQ(plain.tgt, "t");
  EXPECT_EQ(plain.parameters.orientation, Orientation::preserve);
  EXPECT_TRUE(plain.parameters.hints.empty());
  EXPECT_FALSE(plain.parameters.paper_selection);
  EXPECT_TRUE(parse({{"method", "paper"}}).parameters.paper_selection);
  EXPECT_EQ(plain.parameters.elastic_iterations, MatchParameters{}.elastic_iterations);
  EXPECT_EQ(parse({{"refine", "default"}}).parameters.elastic_iterations, MatchParameters{}.elastic_iterations);
  EXPECT_TRUE(parse({{"refine", "none"}}).parameters.elastic_iterations.empty());
  EXPECT_TRUE(parse({{"method", "paper"}, {"refine", "none"}}).parameters.paper_selection);
  EXPECT_EQ(parse({{"orientation", "reverse"}}).parameters.orientation, Orientation::reverse);
  EXPECT_EQ(parse({{"orientation", "any"}}).parameters.orientation, Orientation::any);
  EXPECT_EQ(parse({{"hints", "12:40,0:3"}}).parameters.hints, (std::vector<Hint>{{12, 40}, {0, 3}}));
  EXPECT_EQ(plain.parameters.candidate, 0);
  EXPECT_EQ(parse({{"candidate", "7"}}).parameters.candidate, 7);
}

TEST(MatchQuery, ASymmetryIsOfOneShapeAndItsMirrorImage) {
  HttpRequest request;
  request.query = {{"method", "paper"}, {"refine", "none"}, {"hints", "1:2"}};
  const MatchQuery query = symmetry_query_of("s", RequestParameters(request, {"method", "refine", "hints"}));
  EXPECT_EQ(query.src, "s");
  EXPECT_EQ(query.tgt, "s");
  EXPECT_EQ(query.parameters.orientation, Orientation::reverse);
  EXPECT_TRUE(query.parameters.paper_selection);
  EXPECT_TRUE(query.parameters.elastic_iterations.empty());
  EXPECT_EQ(query.parameters.hints, (std::vector<Hint>{{1, 2}}));
}

TEST(MatchQuery, RefusesWhatItDoesNotKnow) {
  std::string many = "1:1";
  for (int i = 0; i < 64; ++i) many += ",1:1";
  for (const std::string& hints : {std::string("1"), std::string("1:"), std::string(":1"), std::string("1:2:3"), std::string("-1:2"),
                                   std::string("1:2,,3:4"), std::string("1:99999999999"), std::string(" 1:2"), many}) {
    EXPECT_THROW((void)parse({{"hints", hints}}), ProblemError) << hints;
  }
  EXPECT_THROW((void)parse({{"orientation", "mirror"}}), ProblemError);
  EXPECT_THROW((void)parse({{"method", "best"}}), ProblemError);
  EXPECT_THROW((void)parse({{"refine", "more"}}), ProblemError);
  EXPECT_THROW((void)parse({{"candidate", "8"}}), ProblemError);
  EXPECT_THROW((void)parse({{"candidate", "4"}, {"method", "paper"}}), ProblemError);
  EXPECT_THROW((void)parse({{"candidate", "-1"}}), ProblemError);
}

TEST(MatchQuery, ServerTimingIsInMilliseconds) {
  MatchResult result;
  result.seconds = {{"rotation", 0.25}, {"total", 1.5}};
  const auto pointer = std::make_shared<const MatchResult>(result);
  EXPECT_EQ(server_timing({pointer, MatchSource::computed}), "cache;desc=computed, rotation;dur=250.0, total;dur=1500.0");
  EXPECT_EQ(server_timing({pointer, MatchSource::memory}), "cache;desc=memory");
}

}  // namespace
}  // namespace spherematch
