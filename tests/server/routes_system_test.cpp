#include "tests/server/test_service.h"

namespace spherematch {
namespace {

class RoutesSystem : public testing::TestService {};

TEST_F(RoutesSystem, HealthCountsTheWork) {
  EXPECT_EQ(api::from_text<api::Health>(get("/healthz").body), api::Health{});
  EXPECT_EQ(header(get("/healthz"), "Cache-Control"), "no-store");
  engine.hold_preparation = true;
  for (int i = 0; i < 3; ++i) post("sphere " + std::to_string(i), {});
  wait_for_preparations(1);
  const auto health = api::from_text<api::Health>(get("/healthz").body);
  EXPECT_EQ(health.jobs_processing, 1);
  EXPECT_EQ(health.jobs_queued, 2);
  stop_source.request_stop();
  EXPECT_EQ(api::from_text<api::Health>(get("/healthz").body).status, "draining");
}

TEST_F(RoutesSystem, VersionShowsLimitsAndParameters) {
  const auto version = api::from_text<api::Version>(get("/version").body);
  EXPECT_EQ(version.version, "1.2.3");
  EXPECT_EQ(version.engine, "stub-1");
  EXPECT_EQ(version.limits.body_bytes, 64 * 1024 * 1024);
  EXPECT_EQ(version.limits.vertices, 300'000);
  EXPECT_EQ(version.limits.concurrent_uploads, options.concurrent_uploads);
  EXPECT_EQ(version.limits.workers, options.workers);
  EXPECT_EQ(version.limits.threads, options.threads);
  EXPECT_EQ(version.limits.shape_cache_bytes, 256 << 20);
  EXPECT_EQ(version.limits.match_cache_bytes, 64 << 20);
  EXPECT_EQ(version.limits.match_store_bytes, 1 << 30);
  EXPECT_EQ(version.mesh_formats.size(), 6U);
  EXPECT_TRUE(version.parameters["match"].contains("max_candidates"));
  EXPECT_TRUE(version.parameters["preprocess"].contains("eigenpairs"));
}

TEST_F(RoutesSystem, VersionNamesExactlyTheFormatsOfMatch) {
  const auto version = api::from_text<api::Version>(get("/version").body);
  const std::string id = ready("sphere a");
  std::string listed;
  for (const std::string& format : version.match_formats) {
    EXPECT_EQ(get("/match", {{"src", id}, {"tgt", id}, {"format", format}}).status, 200) << format;
    listed += (listed.empty() ? "" : ", ") + format;
  }
  const HttpResponse refused = get("/match", {{"src", id}, {"tgt", id}, {"format", "bogus"}});
  EXPECT_NE(refused.body.find(listed), std::string::npos) << refused.body << listed;
}

TEST_F(RoutesSystem, UnknownParametersAreRefusedEverywhere) {
  for (const char* path : {"/", "/healthz", "/version", "/shapes", "/match", "/shapes/0", "/shapes/0/sphere"}) {
    EXPECT_EQ(problem_code(get(path, {{"bogus", "1"}})), api::Code::invalid_parameter) << path;
  }
}

}  // namespace
}  // namespace spherematch
