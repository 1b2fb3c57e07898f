// Results for people.
#pragma once

#include <string>

#include "bench/pair_benchmark.h"

namespace spherematch::bench {

/// A table of the stages of preparing and of matching. Stages that run side by side have shares of more than the whole together.
[[nodiscard]] std::string table_of(const PairResult& result);

}  // namespace spherematch::bench
