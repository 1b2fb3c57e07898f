#include "server/parameters_json.h"

#include <gtest/gtest.h>

namespace spherematch {
namespace {

// Entity tags are made of this text, so parameters that differ must not look alike.
TEST(ParametersJson, EveryFieldOfAMatchShows) {
  const std::string plain = to_json(MatchParameters{}).dump();
  const auto changed = [&](auto member, auto value) {
    MatchParameters parameters;
    parameters.*member = value;
    return to_json(parameters).dump() != plain;
  };
  EXPECT_TRUE(changed(&MatchParameters::rotation_time, 0.5));
  EXPECT_TRUE(changed(&MatchParameters::rotation_bandwidth, 32));
  EXPECT_TRUE(changed(&MatchParameters::max_candidates, 1));
  EXPECT_TRUE(changed(&MatchParameters::candidate_separation, 1.0));
  EXPECT_TRUE(changed(&MatchParameters::candidate_threshold, 0.2));
  EXPECT_TRUE(changed(&MatchParameters::flow_times, std::vector<double>{0.5}));
  EXPECT_TRUE(changed(&MatchParameters::flow_resolution, 8));
  EXPECT_TRUE(changed(&MatchParameters::flow_iterations, 1));
  EXPECT_TRUE(changed(&MatchParameters::flow_settled, 0.1));
  EXPECT_TRUE(changed(&MatchParameters::flow_smoothness, 0.1));
  EXPECT_TRUE(changed(&MatchParameters::finest_flow, 32));
  EXPECT_TRUE(changed(&MatchParameters::flow_tolerance, 0.2));
  EXPECT_TRUE(changed(&MatchParameters::flow_detail, 0.5));
  EXPECT_TRUE(changed(&MatchParameters::flow_detail_from, 2));
  EXPECT_TRUE(changed(&MatchParameters::mesh_flow, true));
  EXPECT_TRUE(changed(&MatchParameters::elastic_iterations, std::vector<int>{1}));
  EXPECT_TRUE(changed(&MatchParameters::elastic_area, 0.5));
  EXPECT_TRUE(changed(&MatchParameters::elastic_yield, 2.0));
  EXPECT_TRUE(changed(&MatchParameters::elastic_signals, 1.0));
  EXPECT_TRUE(changed(&MatchParameters::elastic_signal_yield, 2.0));
  EXPECT_TRUE(changed(&MatchParameters::elastic_spectrum, 1.0));
  EXPECT_TRUE(changed(&MatchParameters::elastic_eigenfunctions, 7));
  EXPECT_TRUE(changed(&MatchParameters::elastic_more_eigenfunctions, 7));
  EXPECT_TRUE(changed(&MatchParameters::elastic_longest_move, 0.2));
  EXPECT_TRUE(changed(&MatchParameters::elastic_settled, 0.1));
  EXPECT_TRUE(changed(&MatchParameters::flow_repeated, 0));
  EXPECT_TRUE(changed(&MatchParameters::fine_candidates, 3));
  EXPECT_TRUE(changed(&MatchParameters::paper_selection, true));
  EXPECT_TRUE(changed(&MatchParameters::orientation, Orientation::reverse));
  EXPECT_TRUE(changed(&MatchParameters::hints, std::vector<Hint>{{1, 2}}));
  EXPECT_TRUE(changed(&MatchParameters::both, true));
  EXPECT_TRUE(changed(&MatchParameters::candidate, 1));
}

TEST(ParametersJson, WhatTheCallerKnowsIsTold) {
  MatchParameters parameters;
  api::Json json = to_json(parameters);
  EXPECT_EQ(json["orientation"], "preserve");
  EXPECT_EQ(json["hints"].dump(), "[]");
  EXPECT_EQ(json["both"], false);
  parameters.hints = {{12, 40}, {77, 3}};
  parameters.both = true;
  for (const auto& [orientation, name] : {std::pair{Orientation::reverse, "reverse"}, std::pair{Orientation::any, "any"}}) {
    parameters.orientation = orientation;
    json = to_json(parameters);
    EXPECT_EQ(json["orientation"], name);
    EXPECT_EQ(json["hints"].dump(), "[[12,40],[77,3]]");
    EXPECT_EQ(json["both"], true);
  }
}

TEST(ParametersJson, PreprocessingShowsItsValues) {
  PreprocessParameters parameters;
  parameters.hks_times = {1, 0.5};
  const api::Json json = to_json(parameters);
  EXPECT_EQ(json["hks_times"].dump(), "[1.0,0.5]");
  EXPECT_EQ(json["conformal_steps"], parameters.conformal_steps);
  EXPECT_EQ(json["eigenpairs"], parameters.eigenpairs);
}

}  // namespace
}  // namespace spherematch
