#include "server/match_response.h"

#include <gtest/gtest.h>

#include "server/problem.h"

namespace spherematch {
namespace {

TEST(MatchResponse, FieldsAreParsedStrictly) {
  EXPECT_EQ(canonical(parse_fields("")), "");
  EXPECT_EQ(canonical(parse_fields("vertex")), "vertex,");
  EXPECT_EQ(canonical(parse_fields("bary,vertex")), canonical(parse_fields("vertex,bary")));
  EXPECT_EQ(canonical(parse_fields("bary,corners,vertex")), "vertex,corners,bary");
  EXPECT_EQ(canonical(MatchFields{}), "vertex,");
  for (const char* text : {"Vertex", "vertex, bary", "vertices", ",vertex"}) EXPECT_THROW((void)parse_fields(text), ProblemError) << text;
}

TEST(MatchResponse, OnlyTheSelectedArraysAreTaken) {
  MatchResult result;
  result.map.vertex = {2, -1};
  result.map.corners.resize(2, 3);
  result.map.corners << 2, 1, 0, -1, -1, -1;
  result.map.bary.resize(2, 3);
  result.map.bary << 0.5F, 0.25F, 0.25F, 0, 0, 0;
  result.candidates.push_back({{1, 2, 3, 4, 5, 6, 7, 8, 9}, 0.5, 0.25, true});
  result.quality = {{"coverage", 1}};
  result.seconds = {{"total", 2}};

  const api::Match few = match_of(result, parse_fields(""));
  EXPECT_EQ(few.n_src, 2);
  EXPECT_FALSE(few.vertex || few.corners || few.bary);
  const api::Match all = match_of(result, parse_fields("vertex,corners,bary"));
  EXPECT_EQ(*all.vertex, (std::vector<std::int32_t>{2, -1}));
  EXPECT_EQ(*all.corners, (std::vector<std::array<std::int32_t, 3>>{{2, 1, 0}, {-1, -1, -1}}));
  EXPECT_EQ(*all.bary, (std::vector<std::array<float, 3>>{{0.5F, 0.25F, 0.25F}, {0, 0, 0}}));
  ASSERT_EQ(all.candidates.size(), 1U);
  EXPECT_EQ(all.candidates[0].rotation[1], 2);
  EXPECT_TRUE(all.candidates[0].chosen);
  EXPECT_EQ(all.quality, result.quality);
  EXPECT_EQ(all.seconds, result.seconds);
}

TEST(MatchResponse, ServerTimingIsInMilliseconds) {
  EXPECT_EQ(server_timing({{"rotation", 0.25}, {"total", 1.5}}), "rotation;dur=250.0, total;dur=1500.0");
  EXPECT_EQ(server_timing({}), "");
}

}  // namespace
}  // namespace spherematch
