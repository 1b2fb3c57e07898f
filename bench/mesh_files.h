// The mesh files that benchmarks start from, brought to a size.
#pragma once

#include <cstdint>
#include <string>

#include "engine/data/surface.h"

namespace spherematch::bench {

/// The mesh of a file, repaired and with so many vertices (bench/mesh_growth.h), as the bytes of an OFF file.
/// @throws EngineError, std::runtime_error
[[nodiscard]] std::string resized_off(const std::string& file, std::int32_t vertices);

/// What an upload of resized_off() becomes. @throws EngineError, std::runtime_error
[[nodiscard]] Surface read_resized(const std::string& file, std::int32_t vertices);

}  // namespace spherematch::bench
