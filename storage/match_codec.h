// The bytes in which the store keeps the result of a match: as storage/blob_codec.h keeps the parts of a shape.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/data/correspondence.h"

namespace spherematch {

/// Thread-safe. @throws StorageError(too_large)
[[nodiscard]] std::vector<std::byte> encode_match(const MatchResult& result);

/// Bit for bit what was encoded. Thread-safe. @throws StorageError(corrupt_blob, unknown_version)
[[nodiscard]] MatchResult decode_match(std::span<const std::byte> blob);

}  // namespace spherematch
