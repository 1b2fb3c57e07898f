// What evaluate measures, as JSON: the members of the answer to POST /evaluations (docs/http.md).
#pragma once

#include <string>
#include <string_view>

#include "engine/data/evaluation.h"

namespace spherematch {

/// A document with a line end. `source` and `target` name the meshes.
[[nodiscard]] std::string evaluation_json(const Evaluation& evaluation, std::string_view source, std::string_view target);

}  // namespace spherematch
