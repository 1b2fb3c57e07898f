// The parameters of a request that determine a match: the same for every route that needs a map.
#pragma once

#include <string>
#include <string_view>

#include "api/types.h"
#include "server/match_service.h"
#include "server/request_parameters.h"

namespace spherematch {

/// Reads src, tgt, method, refine, orientation, hints and candidate. @throws ProblemError(invalid_parameter)
[[nodiscard]] MatchQuery match_query_of(const RequestParameters& parameters);

/// The query for the symmetry of a shape, its match with its own mirror image. Reads method, refine, hints and candidate.
/// @throws ProblemError(invalid_parameter)
[[nodiscard]] MatchQuery symmetry_query_of(const std::string& shape, const RequestParameters& parameters);

/// Reads cache. @throws ProblemError(invalid_parameter)
[[nodiscard]] MatchService::Cache cache_of(const RequestParameters& parameters);

/// From words as they stand in a JSON body. @throws ProblemError(invalid_parameter)
[[nodiscard]] MatchParameters match_parameters_of(std::string_view method, std::string_view refine, std::string_view orientation);

/// Waits up to `wait` until both shapes are ready.
/// @throws ProblemError(not_found, shape_failed, shape_not_ready, overloaded, draining)
void await_shapes(ShapeService& shapes, const MatchQuery& query, std::chrono::milliseconds wait);

/// The value of a Server-Timing header: where the result came from, and the seconds of its stages where it was computed for this request.
[[nodiscard]] std::string server_timing(const MatchAnswer& answer);

}  // namespace spherematch
