#include "cli/progress_bar.h"

#include <gtest/gtest.h>

#include <sstream>

namespace spherematch {
namespace {

TEST(ProgressBar, IsSilentWhereThereIsNoTerminal) {
  std::ostringstream out;
  {
    ProgressBar bar(out, false);
    bar.report("conformal", 0.5);
  }
  EXPECT_EQ(out.str(), "");
}

TEST(ProgressBar, ShowsStageAndShareAndWipesItself) {
  std::ostringstream out;
  {
    ProgressBar bar(out, true);
    bar.report("conformal", 0.5);
    EXPECT_TRUE(out.str().ends_with("[####################                    ] 50% conformal")) << out.str();
  }
  EXPECT_TRUE(out.str().ends_with("\r\x1b[K"));
}

TEST(ProgressBar, NeverMovesBackAndStaysInside) {
  std::ostringstream out;
  ProgressBar bar(out, true);
  bar.report("a", 0.75);
  bar.report("b", 0.25);
  EXPECT_TRUE(out.str().ends_with("75% b"));
  bar.report("c", 7);
  EXPECT_TRUE(out.str().ends_with("[########################################] 100% c")) << out.str();
}

TEST(ProgressBar, DoesNotRedrawForEveryReport) {
  std::ostringstream out;
  ProgressBar bar(out, true);
  for (int i = 0; i < 10'000; ++i) bar.report("a", i / 1e4);
  EXPECT_LT(out.str().size(), 10'000U);
}

}  // namespace
}  // namespace spherematch
