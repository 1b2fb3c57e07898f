// Results as text: for files, and between processes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/pair_benchmark.h"

namespace spherematch::bench {

/// One JSON object; README.md in this folder names its members.
[[nodiscard]] std::string to_text(const PairResult& result);
/// What to_text() got. @throws std::exception for any other text
[[nodiscard]] PairResult result_from(std::string_view text);

/// A whole file: engine version, settings and every result.
[[nodiscard]] std::string file_text(const BenchmarkSettings& settings, const std::vector<PairResult>& results);

}  // namespace spherematch::bench
