// What cached values take in memory.
#pragma once

#include <cstddef>

#include "engine/data/correspondence.h"
#include "engine/data/preprocessed_shape.h"

namespace spherematch {

/// Bytes of the value and its arrays.
[[nodiscard]] std::size_t memory_size(const PreprocessedShape& shape);
[[nodiscard]] std::size_t memory_size(const MatchResult& result);

}  // namespace spherematch
