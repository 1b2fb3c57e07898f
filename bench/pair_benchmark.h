// One pair of shapes at one size: what preparing and matching takes, stage by stage.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/stage_times.h"

namespace spherematch::bench {

struct BenchmarkSettings {
  int runs = 5;
  double budget_seconds = 120;  ///< for the runs of one size, of preparation and match each; the first run is always made
  int threads = 2;
  bool both = false;  ///< match in both directions (MatchParameters::both)
};

struct PairResult {
  std::string source;  ///< as given
  std::string target;
  std::int32_t vertices = 0;  ///< of either
  double read_seconds = 0;    ///< of the source as an OFF file: reading and checks; no part of the preparation
  Timing preparation;         ///< of the source
  double preparation_mebibytes = 0;
  Timing match;
  double match_mebibytes = 0;  ///< peak with both shapes in memory
};

/// Brings two mesh files to so many vertices, and prepares and matches them in a process of its own.
/// @throws std::exception; only while this process has no other threads
[[nodiscard]] PairResult run_pair(const std::string& source, const std::string& target, std::int32_t vertices,
                                  const BenchmarkSettings& settings);

}  // namespace spherematch::bench
