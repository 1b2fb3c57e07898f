// What a Prometheus server scrapes: counts and times of what happened, and how things stand at the moment.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spherematch {

/// How things stand when somebody looks.
struct MetricsSnapshot {
  struct Count {
    std::string kind;
    std::string state;
    std::size_t count = 0;
  };
  std::vector<Count> jobs;
  std::vector<std::pair<std::string, std::size_t>> matches;      ///< state, requests
  std::vector<std::pair<std::string, std::size_t>> cache_bytes;  ///< cache, bytes
  std::uintmax_t store_bytes = 0;
};

/// Thread-safe.
class Metrics {
 public:
  Metrics(const std::string& version, const std::string& engine);
  ~Metrics();
  Metrics(const Metrics&) = delete;
  Metrics& operator=(const Metrics&) = delete;

  /// `route` is a pattern, never a path, so that the number of series is bounded.
  void request_finished(std::string_view method, std::string_view route, int status, double seconds);
  /// `cache` says where the result came from: computed, memory, store or joined.
  void match_finished(std::string_view cache, double seconds);
  void stage_finished(std::string_view stage, double seconds);

  /// Prometheus's text format, version 0.0.4.
  [[nodiscard]] std::string text(const MetricsSnapshot& snapshot) const;

 private:
  struct Series;
  std::unique_ptr<Series> series_;
};

}  // namespace spherematch
