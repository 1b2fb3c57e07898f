#include "server/metrics.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>
#include <thread>

namespace spherematch {
namespace {

/// Reads the text format, and fails the test where a line breaks its rules.
struct Scrape {
  explicit Scrape(const std::string& text) {
    EXPECT_TRUE(text.ends_with('\n'));
    std::istringstream in(text);
    std::string line;
    while (std::getline(in, line)) {
      std::istringstream words(line);
      std::string hash, keyword, name;
      if (line.starts_with("#")) {
        words >> hash >> keyword >> name;
        if (keyword == "HELP") {
          EXPECT_TRUE(helped.insert(name).second) << "twice: " << line;
        } else {
          EXPECT_EQ(keyword, "TYPE") << line;
          words >> types[name];
        }
        continue;
      }
      const auto space = line.rfind(' ');
      if (space == std::string::npos) {
        ADD_FAILURE() << line;
        continue;
      }
      const std::string series = line.substr(0, space);
      EXPECT_TRUE(values.emplace(series, std::stod(line.substr(space + 1))).second) << "twice: " << series;
      EXPECT_TRUE(types.contains(base_of(series.substr(0, series.find('{'))))) << line;
    }
    for (const auto& [name, type] : types) EXPECT_TRUE(helped.contains(name)) << name;
  }
  /// Of a histogram's series the histogram.
  [[nodiscard]] std::string base_of(std::string name) const {
    for (const std::string_view suffix : {"_bucket", "_sum", "_count"}) {
      if (name.ends_with(suffix) && types.contains(name.substr(0, name.size() - suffix.size()))) {
        return name.substr(0, name.size() - suffix.size());
      }
    }
    return name;
  }
  [[nodiscard]] double at(const std::string& series) const {
    const auto found = values.find(series);
    EXPECT_NE(found, values.end()) << series;
    return found == values.end() ? -1 : found->second;
  }

  std::map<std::string, std::string> types;
  std::set<std::string> helped;
  std::map<std::string, double> values;
};

TEST(Metrics, CountsRequestsByMethodRouteAndCode) {
  Metrics metrics("1.2.3", "7");
  metrics.request_finished("GET", "/shapes/{id}", 200, 0.003);
  metrics.request_finished("GET", "/shapes/{id}", 200, 0.2);
  metrics.request_finished("GET", "/shapes/{id}", 404, 0.0001);
  metrics.request_finished("BREW", "-", 400, 0.0001);
  const Scrape scrape(metrics.text({}));
  EXPECT_EQ(scrape.at(R"(spherematch_http_requests_total{code="200",method="GET",route="/shapes/{id}"})"), 2);
  EXPECT_EQ(scrape.at(R"(spherematch_http_requests_total{code="404",method="GET",route="/shapes/{id}"})"), 1);
  EXPECT_EQ(scrape.at(R"(spherematch_http_requests_total{code="400",method="other",route="-"})"), 1);
  EXPECT_EQ(scrape.types.at("spherematch_http_requests_total"), "counter");
  EXPECT_EQ(scrape.at(R"(spherematch_http_request_duration_seconds_count{route="/shapes/{id}"})"), 3);
  EXPECT_NEAR(scrape.at(R"(spherematch_http_request_duration_seconds_sum{route="/shapes/{id}"})"), 0.2031, 1e-9);
  EXPECT_EQ(scrape.at(R"(spherematch_http_request_duration_seconds_bucket{route="/shapes/{id}",le="0.005"})"), 2);
  EXPECT_EQ(scrape.at(R"(spherematch_http_request_duration_seconds_bucket{route="/shapes/{id}",le="+Inf"})"), 3);
  EXPECT_EQ(scrape.types.at("spherematch_http_request_duration_seconds"), "histogram");
}

TEST(Metrics, TimesMatchesAndStages) {
  Metrics metrics("1.2.3", "7");
  metrics.match_finished("memory", 0.002);
  metrics.stage_finished("conformal", 1.5);
  const Scrape scrape(metrics.text({}));
  EXPECT_EQ(scrape.at(R"(spherematch_match_duration_seconds_count{cache="memory"})"), 1);
  for (const char* idle : {"computed", "store", "joined"}) {
    EXPECT_EQ(scrape.at("spherematch_match_duration_seconds_count{cache=\"" + std::string(idle) + "\"}"), 0);
  }
  EXPECT_EQ(scrape.at(R"(spherematch_preparation_stage_duration_seconds_sum{stage="conformal"})"), 1.5);
}

TEST(Metrics, ShowsHowThingsStand) {
  const Metrics metrics("1.2.3", "7");
  const Scrape scrape(metrics.text({.jobs = {{"preprocess", "queued", 3}, {"preprocess", "processing", 1}},
                                    .matches = {{"running", 2}},
                                    .cache_bytes = {{"shapes", 1 << 30}},
                                    .store_bytes = 4096}));
  EXPECT_EQ(scrape.at(R"(spherematch_build_info{engine="7",version="1.2.3"})"), 1);
  EXPECT_EQ(scrape.at(R"(spherematch_jobs{kind="preprocess",state="queued"})"), 3);
  EXPECT_EQ(scrape.at(R"(spherematch_jobs{kind="preprocess",state="processing"})"), 1);
  EXPECT_EQ(scrape.at(R"(spherematch_matches{state="running"})"), 2);
  EXPECT_EQ(scrape.at(R"(spherematch_cache_bytes{cache="shapes"})"), 1 << 30);
  EXPECT_EQ(scrape.at("spherematch_store_bytes"), 4096);
  EXPECT_GT(scrape.at("process_resident_memory_bytes"), 1e6);
  EXPECT_GT(scrape.at("process_start_time_seconds"), 1e9);
  EXPECT_GE(scrape.at("process_open_fds"), 3);
  EXPECT_GE(scrape.at("process_cpu_seconds_total"), 0);
  EXPECT_EQ(scrape.types.at("process_cpu_seconds_total"), "counter");
}

TEST(Metrics, ManyThreadsMayReport) {
  Metrics metrics("1.2.3", "7");
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&] {
        for (int k = 0; k < 500; ++k) metrics.request_finished("GET", "/", 200, 0.001);
      });
    }
    for (int k = 0; k < 20; ++k) Scrape(metrics.text({}));
  }
  EXPECT_EQ(Scrape(metrics.text({})).at(R"(spherematch_http_requests_total{code="200",method="GET",route="/"})"), 2000);
}

}  // namespace
}  // namespace spherematch
