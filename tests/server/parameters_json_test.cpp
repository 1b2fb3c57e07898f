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
  EXPECT_TRUE(changed(&MatchParameters::rotation_bandwidth, 16));
  EXPECT_TRUE(changed(&MatchParameters::max_candidates, 1));
  EXPECT_TRUE(changed(&MatchParameters::candidate_separation, 1.0));
  EXPECT_TRUE(changed(&MatchParameters::candidate_threshold, 0.2));
  EXPECT_TRUE(changed(&MatchParameters::flow_times, std::vector<double>{0.5}));
  EXPECT_TRUE(changed(&MatchParameters::flow_resolution, 8));
  EXPECT_TRUE(changed(&MatchParameters::flow_iterations, 1));
  EXPECT_TRUE(changed(&MatchParameters::flow_smoothness, 0.1));
  EXPECT_TRUE(changed(&MatchParameters::paper_selection, true));
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
