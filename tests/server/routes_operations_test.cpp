#include "server/routes_operations.h"

#include "tests/server/test_service.h"

namespace spherematch {
namespace {

class RoutesOperations : public testing::TestService {
 protected:
  RoutesOperations() {
    add_metrics_route(*router, metrics, [this] {
      const JobRunner::Counts jobs = shapes->job_counts();
      return MetricsSnapshot{
          .jobs = {{"preprocess", "processing", jobs.running}}, .matches = {}, .cache_bytes = {{"shapes", shapes->cache_bytes()}}};
    });
    readiness.add("store", [this] { return store_answer; });
    readiness.add("preparations", [this] { return check_progress("preparations", shapes->job_counts().silence, limit); });
    add_readiness_route(*router, readiness);
  }

  Metrics metrics{"1.2.3", "stub-1"};
  Readiness readiness;
  BackgroundCheck::Answer store_answer{.good = true, .detail = "a write took 0 ms"};
  std::chrono::seconds limit{600};
};

TEST_F(RoutesOperations, MetricsAreWhatPrometheusReads) {
  const HttpResponse response = get("/metrics");
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(response.content_type, "text/plain; version=0.0.4; charset=utf-8");
  EXPECT_EQ(header(response, "Cache-Control"), "no-store");
  EXPECT_NE(response.body.find("spherematch_jobs{kind=\"preprocess\",state=\"processing\"} 0"), std::string::npos);
  EXPECT_NE(response.body.find("spherematch_cache_bytes{cache=\"shapes\"} 0\n"), std::string::npos);
  ready("sphere a");
  EXPECT_EQ(get("/metrics").body.find("spherematch_cache_bytes{cache=\"shapes\"} 0\n"), std::string::npos);
  EXPECT_EQ(problem_code(get("/metrics", {{"bogus", "1"}})), api::Code::invalid_parameter);
}

TEST_F(RoutesOperations, ReadyIsOneLinePerCheck) {
  const HttpResponse response = get("/readyz");
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(header(response, "Cache-Control"), "no-store");
  const auto checks = api::from_text<api::Readiness>(response.body).checks;
  ASSERT_EQ(checks.size(), 2U);
  EXPECT_EQ(checks[0], (api::ReadinessCheck{"store", true, "a write took 0 ms"}));
  EXPECT_EQ(problem_code(get("/readyz", {{"bogus", "1"}})), api::Code::invalid_parameter);
}

TEST_F(RoutesOperations, NotReadyIsAProblemWithTheSameLines) {
  store_answer = {.good = false, .detail = "there is no space left for the store"};
  const HttpResponse response = get("/readyz");
  EXPECT_EQ(response.status, 503);
  EXPECT_EQ(header(response, "Cache-Control"), "no-store");
  EXPECT_EQ(header(response, "Retry-After"), "5");
  const auto problem = api::from_text<api::Problem>(response.body);
  EXPECT_EQ(problem.code, api::Code::not_ready);
  EXPECT_EQ(problem.detail, "store: there is no space left for the store");
  ASSERT_EQ(problem.checks.size(), 2U);
  EXPECT_TRUE(problem.checks[1].ok);
}

TEST_F(RoutesOperations, APreparationThatHangsIsNoticed) {
  limit = std::chrono::seconds(0);
  EXPECT_EQ(get("/readyz").status, 200);
  engine.hold_preparation = true;
  post("sphere a", {});
  wait_for_preparations(1);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const auto problem = api::from_text<api::Problem>(get("/readyz").body);
  EXPECT_NE(problem.detail.find("nothing heard of the preparations"), std::string::npos) << problem.detail;
  limit = std::chrono::seconds(600);
  EXPECT_EQ(get("/readyz").status, 200);
}

TEST_F(RoutesOperations, StagesOfAPreparationAreReported) {
  stop();
  std::mutex mutex;
  std::set<std::string> stages;
  ShapeServiceSettings settings;
  settings.on_stage = [&](std::string_view stage, double seconds) {
    EXPECT_GE(seconds, 0);
    const std::lock_guard lock(mutex);
    stages.emplace(stage);
  };
  start(settings);
  ready("sphere a");
  const std::lock_guard lock(mutex);
  EXPECT_TRUE(stages.contains("total")) << stages.size();
}

}  // namespace
}  // namespace spherematch
