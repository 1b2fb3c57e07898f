// A match result in each representation.
#pragma once

#include <string>
#include <string_view>

#include "api/types.h"
#include "engine/data/correspondence.h"

namespace spherematch {

/// The arrays that JSON carries; the others are always whole.
struct MatchFields {
  bool vertex = true;
  bool corners = false;
  bool bary = false;
};

/// "vertex,bary" and the like; an empty text selects none. @throws ProblemError(invalid_parameter)
[[nodiscard]] MatchFields parse_fields(std::string_view text);

/// The same text for the same selection, whatever its order.
[[nodiscard]] std::string canonical(const MatchFields& fields);

/// Everything but src, tgt, n_tgt and engine, which the caller knows.
[[nodiscard]] api::Match match_of(const MatchResult& result, const MatchFields& fields);

/// Stage seconds as the value of a Server-Timing header, in milliseconds.
[[nodiscard]] std::string server_timing(const StageSeconds& seconds);

}  // namespace spherematch
