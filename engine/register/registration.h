// Registration of a pair: candidates, flow, selection, composition.
#pragma once

#include "engine/data/correspondence.h"
#include "engine/data/parameters.h"
#include "engine/data/progress.h"
#include "engine/register/match_shape.h"

namespace spherematch {

/// The stages of engine.h's match() in order, candidates in parallel on up to `threads` threads.
/// @throws EngineError(cancelled, invalid_parameter)
[[nodiscard]] MatchResult register_pair(const MatchShape& source, const MatchShape& target, const MatchParameters& parameters,
                                        const Progress& progress, int threads);

}  // namespace spherematch
