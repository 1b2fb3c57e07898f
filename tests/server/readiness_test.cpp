#include "server/readiness.h"

#include <gtest/gtest.h>

#include "tests/server/temporary_directory.h"

namespace spherematch {
namespace {

using std::chrono::seconds;

TEST(Readiness, ReportsEveryCheckInOrder) {
  Readiness readiness;
  readiness.add("first", [] { return BackgroundCheck::Answer{.good = true, .detail = "fine"}; });
  readiness.add("second", [] { return BackgroundCheck::Answer{.good = false, .detail = "broken"}; });
  EXPECT_EQ(readiness.report(), (std::vector<api::ReadinessCheck>{{"first", true, "fine"}, {"second", false, "broken"}}));
}

TEST(Readiness, FreeSpaceIsThatOfTheStoresDisk) {
  const testing::TemporaryDirectory place;
  EXPECT_TRUE(check_free_space(place.path() / "s.db", 1).good);
  const auto full = check_free_space(place.path() / "s.db", std::uintmax_t{1} << 60);
  EXPECT_FALSE(full.good);
  EXPECT_NE(full.detail.find("fewer than 1099511627776"), std::string::npos) << full.detail;
  EXPECT_FALSE(check_free_space(place.path() / "missing" / "s.db", 1).good);
  EXPECT_TRUE(check_free_space("s.db", 1).good);
}

TEST(Readiness, SilenceBeyondTheLimitIsAHang) {
  EXPECT_TRUE(check_progress("matches", seconds(0), seconds(5)).good);
  EXPECT_TRUE(check_progress("matches", seconds(5), seconds(5)).good);
  const auto hang = check_progress("matches", seconds(7), seconds(5));
  EXPECT_FALSE(hang.good);
  EXPECT_EQ(hang.detail, "nothing heard of the matches for 7 s");
}

}  // namespace
}  // namespace spherematch
