#include "bench/stage_times.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "bench/process_usage.h"

namespace spherematch::bench {

namespace {

/// Of the stages of the first run; every run of the same thing has the same.
StageSeconds medians(const std::vector<StageSeconds>& runs) {
  StageSeconds result;
  for (const auto& [stage, first] : runs.front()) {
    std::vector<double> values;
    for (const StageSeconds& run : runs) {
      for (const auto& [name, seconds] : run) {
        if (name == stage) values.push_back(seconds);
      }
    }
    result.emplace_back(stage, median(std::move(values)));
  }
  return result;
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

Timing measure(int runs, double budget_seconds, const std::function<StageSeconds()>& run) {
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [start] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  std::vector<StageSeconds> stages;
  std::vector<double> cpu;
  do {
    const double before = cpu_seconds();
    stages.push_back(run());
    cpu.push_back(cpu_seconds() - before);
  } while (static_cast<int>(stages.size()) < runs && elapsed() < budget_seconds);
  return {.seconds = medians(stages), .cpu_seconds = median(std::move(cpu)), .runs = static_cast<int>(stages.size())};
}

double total_of(const StageSeconds& seconds) {
  for (const auto& [stage, value] : seconds) {
    if (stage == "total") return value;
  }
  return 0;
}

}  // namespace spherematch::bench
