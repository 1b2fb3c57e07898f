#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <thread>
#include <vector>

#include "bench/process_usage.h"
#include "bench/results_json.h"
#include "bench/stage_times.h"

namespace spherematch::bench {
namespace {

TEST(Median, IsTheMiddleOrBetweenTheMiddleTwo) {
  EXPECT_EQ(median({}), 0);
  EXPECT_EQ(median({3}), 3);
  EXPECT_EQ(median({9, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 100}), 3);
}

TEST(Measure, TakesTheMedianOfEachStageByItself) {
  const std::vector<StageSeconds> runs{{{"a", 1}, {"total", 9}}, {{"a", 5}, {"total", 8}}, {{"a", 3}, {"total", 10}}};
  std::size_t next = 0;
  const Timing timing = measure(3, 60, [&] { return runs[next++]; });
  EXPECT_EQ(timing.runs, 3);
  EXPECT_EQ(timing.seconds, (StageSeconds{{"a", 3}, {"total", 9}}));
  EXPECT_EQ(total_of(timing.seconds), 9);
}

TEST(Measure, StopsWhenTheBudgetIsSpentButRunsOnce) {
  EXPECT_EQ(measure(1000, 0, [] { return StageSeconds{{"total", 1}}; }).runs, 1);
}

TEST(ProcessUsage, SeesAndForgetsAPeakOfMemory) {
  reset_peak_memory();
  const double before = peak_mebibytes();
  EXPECT_GT(before, 1);
  {
    const std::vector<char> large(std::size_t{64} << 20, 'x');
    EXPECT_GT(peak_mebibytes(), before + 60);
  }
  EXPECT_GT(peak_mebibytes(), before + 60);
  reset_peak_memory();
  EXPECT_LT(peak_mebibytes(), before + 30);
}

TEST(InChild, ReturnsAnswersErrorsAndEnds) {
  EXPECT_EQ(in_child([] { return std::string(100'000, 'a'); }), std::string(100'000, 'a'));
  EXPECT_EQ(in_child([] { return std::string(); }), "");
  try {
    (void)in_child([]() -> std::string { throw std::runtime_error("no such mesh"); });
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "no such mesh");
  }
  EXPECT_THROW((void)in_child([]() -> std::string { std::_Exit(3); }), std::runtime_error);
}

TEST(Results, SurviveText) {
  PairResult result;
  result.source = "a.off";
  result.target = "b.off";
  result.vertices = 1234;
  result.read_seconds = 0.25;
  result.preparation = {.seconds = {{"z", 0.5}, {"a", 1.0 / 3}, {"total", 1}}, .cpu_seconds = 1.5, .runs = 3};
  result.preparation_mebibytes = 17.5;
  result.match = {.seconds = {{"total", 2}}, .cpu_seconds = 2.5, .runs = 5};
  result.match_mebibytes = 18.5;
  const PairResult back = result_from(to_text(result));
  EXPECT_EQ(to_text(back), to_text(result));
  EXPECT_EQ(back.preparation.seconds, result.preparation.seconds);
  EXPECT_EQ(back.match.runs, 5);
  EXPECT_EQ(back.match_mebibytes, 18.5);
}

}  // namespace
}  // namespace spherematch::bench
