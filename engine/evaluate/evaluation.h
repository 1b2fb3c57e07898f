// Everything that is measured of a map, together.
#pragma once

#include "engine/data/correspondence.h"
#include "engine/data/evaluation.h"
#include "engine/data/preprocessed_shape.h"
#include "engine/data/progress.h"

namespace spherematch {

/// What engine.h's evaluate() does.
/// @throws EngineError(cancelled, invalid_parameter)
[[nodiscard]] Evaluation evaluate_map(const PreprocessedShape& source, const PreprocessedShape& target, const Correspondence& map,
                                      const Correspondence* reverse, const GroundTruth& truth, const Progress& progress, int threads);

}  // namespace spherematch
