#include "server/match_response.h"

#include <gtest/gtest.h>

#include "server/problem.h"
#include "tests/server/stub_engine.h"

namespace spherematch {
namespace {

TEST(MatchResponse, FieldsAreParsedStrictly) {
  EXPECT_EQ(canonical(parse_fields("")), "");
  EXPECT_EQ(canonical(parse_fields("vertex")), "vertex,");
  EXPECT_EQ(canonical(parse_fields("bary,vertex")), canonical(parse_fields("vertex,bary")));
  EXPECT_EQ(canonical(parse_fields("bary,corners,vertex")), "vertex,corners,bary");
  EXPECT_EQ(canonical(parse_fields("distortion,confidence")), ",confidence,distortion");
  EXPECT_FALSE(parse_fields("vertex").quality());
  EXPECT_TRUE(parse_fields("distortion").quality());
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

  testing::StubEngine engine;
  engine.version_text = "7";
  const auto shape = std::make_shared<const PreprocessedShape>();
  const MatchedShapes shapes{shape, shape};
  MatchQuery query{"s", "t", {}};
  const auto match = [&](const char* fields, MatchSource source = MatchSource::computed) {
    return match_of(query, {std::make_shared<const MatchResult>(result), source}, parse_fields(fields), 3, engine, shapes);
  };
  const api::Match few = match("");
  EXPECT_EQ(few.src, "s");
  EXPECT_EQ(few.tgt, "t");
  EXPECT_EQ(few.n_src, 2);
  EXPECT_EQ(few.n_tgt, 3);
  EXPECT_EQ(few.engine, "7");
  EXPECT_EQ(few.orientation, "preserve");
  EXPECT_FALSE(few.cached || few.reverse);
  EXPECT_TRUE(match("", MatchSource::store).cached);
  EXPECT_TRUE(match("", MatchSource::memory).cached);
  EXPECT_FALSE(match("", MatchSource::joined).cached);
  EXPECT_FALSE(few.vertex || few.corners || few.bary || few.confidence || few.distortion);
  const api::Match judged = match("distortion,confidence");
  EXPECT_EQ(*judged.distortion, (std::vector<float>{0.25F, 0.25F}));
  EXPECT_EQ(*judged.confidence, (std::vector<float>{0.75F, 0.75F}));
  EXPECT_FALSE(match("distortion").confidence);
  EXPECT_TRUE(quality_of(result.map, parse_fields("vertex"), engine, nullptr, nullptr).confidence.empty());
  const VertexQuality quality = quality_of(result.map, parse_fields("confidence"), engine, shape, shape);
  EXPECT_EQ(quality.confidence, *judged.confidence);
  EXPECT_TRUE(quality.distortion.empty());
  const api::Match all = match("vertex,corners,bary");
  EXPECT_EQ(*all.vertex, (std::vector<std::int32_t>{2, -1}));
  EXPECT_EQ(*all.corners, (std::vector<std::array<std::int32_t, 3>>{{2, 1, 0}, {-1, -1, -1}}));
  EXPECT_EQ(*all.bary, (std::vector<std::array<float, 3>>{{0.5F, 0.25F, 0.25F}, {0, 0, 0}}));
  ASSERT_EQ(all.candidates.size(), 1U);
  EXPECT_EQ(all.candidates[0].rotation[1], 2);
  EXPECT_TRUE(all.candidates[0].chosen);
  EXPECT_EQ(all.quality, result.quality);
  EXPECT_EQ(all.seconds, result.seconds);

  EXPECT_EQ(all.candidate, 0);
  query.parameters.both = true;
  query.parameters.candidate = 1;
  result.reverse.vertex = {0, 1, 1};
  result.reversed = true;
  const api::Match both = match("vertex");
  EXPECT_EQ(both.orientation, "reverse");
  EXPECT_EQ(both.candidate, 1);
  EXPECT_EQ(both.reverse->n_src, 3);
  EXPECT_EQ(both.reverse->n_tgt, 2);
  EXPECT_EQ(*both.reverse->vertex, (std::vector<std::int32_t>{0, 1, 1}));
  EXPECT_FALSE(both.reverse->corners);
}

}  // namespace
}  // namespace spherematch
