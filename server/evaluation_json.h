// Evaluations between the engine's types and those that travel.
#pragma once

#include <string>

#include "api/evaluation.h"
#include "engine/data/evaluation.h"
#include "server/match_service.h"

namespace spherematch {

/// @throws ProblemError(length_mismatch), ProblemError(invalid_parameter) where the truth does not fit so many uploaded vertices
[[nodiscard]] GroundTruth truth_of(const api::EvaluationRequest& request, std::int32_t source_vertices, std::int32_t target_vertices);

[[nodiscard]] api::Evaluation evaluation_of(const MatchQuery& query, const MatchAnswer& answer, const Evaluation& evaluation,
                                            const std::string& engine);

}  // namespace spherematch
