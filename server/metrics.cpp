#include "server/metrics.h"

#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

#include <algorithm>
#include <array>

#include "server/process_figures.h"

namespace spherematch {

namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;

constexpr std::array<std::string_view, 9> methods{"GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS", "TRACE", "CONNECT"};
constexpr std::array<std::string_view, 4> match_sources{"computed", "memory", "store", "joined"};

/// From a 304 to a long poll.
const prometheus::Histogram::BucketBoundaries request_buckets{0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25,
                                                              0.5,   1,      2.5,   5,    10,    30,   60};
const prometheus::Histogram::BucketBoundaries stage_buckets{0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5, 5, 10, 30, 60, 120, 300};

MetricFamily family(std::string name, std::string help, MetricType type) {
  MetricFamily result;
  result.name = std::move(name);
  result.help = std::move(help);
  result.type = type;
  return result;
}

void add(MetricFamily& to, double value, std::vector<ClientMetric::Label> labels = {}) {
  ClientMetric metric;
  metric.label = std::move(labels);
  metric.gauge.value = value;
  metric.counter.value = value;
  to.metric.push_back(std::move(metric));
}

MetricFamily single(std::string name, std::string help, MetricType type, double value) {
  MetricFamily result = family(std::move(name), std::move(help), type);
  add(result, value);
  return result;
}

void add_snapshot(std::vector<MetricFamily>& to, const MetricsSnapshot& snapshot) {
  MetricFamily jobs = family("spherematch_jobs", "Jobs that are queued or processing", MetricType::Gauge);
  for (const auto& [kind, state, count] : snapshot.jobs) add(jobs, static_cast<double>(count), {{"kind", kind}, {"state", state}});
  MetricFamily matches = family("spherematch_matches", "Matches being computed or waiting for their turn", MetricType::Gauge);
  for (const auto& [state, count] : snapshot.matches) add(matches, static_cast<double>(count), {{"state", state}});
  MetricFamily caches = family("spherematch_cache_bytes", "Bytes that a cache holds", MetricType::Gauge);
  for (const auto& [cache, bytes] : snapshot.cache_bytes) add(caches, static_cast<double>(bytes), {{"cache", cache}});
  to.insert(to.end(), {std::move(jobs), std::move(matches), std::move(caches)});
  to.push_back(
      single("spherematch_store_bytes", "Bytes of the store's files", MetricType::Gauge, static_cast<double>(snapshot.store_bytes)));
}

void add_process(std::vector<MetricFamily>& to) {
  const ProcessFigures figures = process_figures();
  to.push_back(single("process_cpu_seconds_total", "Processor time of the server, without its preparations", MetricType::Counter,
                      figures.cpu_seconds));
  to.push_back(
      single("process_resident_memory_bytes", "Memory of the server, without its preparations", MetricType::Gauge, figures.resident_bytes));
  to.push_back(single("process_open_fds", "Open file descriptors", MetricType::Gauge, figures.open_files));
  to.push_back(single("process_max_fds", "File descriptors that may be open", MetricType::Gauge, figures.max_files));
  to.push_back(
      single("process_start_time_seconds", "When the server was started, in seconds since 1970", MetricType::Gauge, figures.started));
}

}  // namespace

struct Metrics::Series {
  prometheus::Registry registry;
  prometheus::Family<prometheus::Counter>& requests =
      prometheus::BuildCounter().Name("spherematch_http_requests_total").Help("Requests that were answered").Register(registry);
  prometheus::Family<prometheus::Histogram>& request_seconds = prometheus::BuildHistogram()
                                                                   .Name("spherematch_http_request_duration_seconds")
                                                                   .Help("From the head of a request to the end of its response")
                                                                   .Register(registry);
  prometheus::Family<prometheus::Histogram>& match_seconds = prometheus::BuildHistogram()
                                                                 .Name("spherematch_match_duration_seconds")
                                                                 .Help("Matches by where their result came from")
                                                                 .Register(registry);
  prometheus::Family<prometheus::Histogram>& stage_seconds = prometheus::BuildHistogram()
                                                                 .Name("spherematch_preparation_stage_duration_seconds")
                                                                 .Help("Stages of finished preparations; total is all of them")
                                                                 .Register(registry);
};

Metrics::Metrics(const std::string& version, const std::string& engine) : series_(std::make_unique<Series>()) {
  prometheus::BuildGauge()
      .Name("spherematch_build_info")
      .Help("Always 1; the labels say what runs")
      .Register(series_->registry)
      .Add({{"version", version}, {"engine", engine}})
      .Set(1);
  // A series that is there from the start lets a rate begin at zero.
  for (const std::string_view cache : match_sources) series_->match_seconds.Add({{"cache", std::string(cache)}}, request_buckets);
}

Metrics::~Metrics() = default;

void Metrics::request_finished(std::string_view method, std::string_view route, int status, double seconds) {
  const bool is_known = std::find(methods.begin(), methods.end(), method) != methods.end();
  series_->requests
      .Add({{"method", std::string(is_known ? method : "other")}, {"route", std::string(route)}, {"code", std::to_string(status)}})
      .Increment();
  series_->request_seconds.Add({{"route", std::string(route)}}, request_buckets).Observe(seconds);
}

void Metrics::match_finished(std::string_view cache, double seconds) {
  series_->match_seconds.Add({{"cache", std::string(cache)}}, request_buckets).Observe(seconds);
}

void Metrics::stage_finished(std::string_view stage, double seconds) {
  series_->stage_seconds.Add({{"stage", std::string(stage)}}, stage_buckets).Observe(seconds);
}

std::string Metrics::text(const MetricsSnapshot& snapshot) const {
  std::vector<MetricFamily> families = series_->registry.Collect();
  add_snapshot(families, snapshot);
  add_process(families);
  // One that has no series yet would be a name without a value.
  std::erase_if(families, [](const MetricFamily& empty) { return empty.metric.empty(); });
  return prometheus::TextSerializer().Serialize(families);
}

}  // namespace spherematch
