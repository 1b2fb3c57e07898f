// The engine's parameters by name: shown at /version, and part of a result's entity tag.
#pragma once

#include "api/types.h"
#include "engine/data/parameters.h"

namespace spherematch {

[[nodiscard]] api::Json to_json(const PreprocessParameters& parameters);
[[nodiscard]] api::Json to_json(const MatchParameters& parameters);

}  // namespace spherematch
