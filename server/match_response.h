// A match result in each representation.
#pragma once

#include <string>
#include <string_view>

#include "api/types.h"
#include "server/match_service.h"

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

/// With the reverse map where the query asks for both.
[[nodiscard]] api::Match match_of(const MatchQuery& query, const MatchAnswer& answer, const MatchFields& fields, std::int32_t n_tgt,
                                  const std::string& engine);

}  // namespace spherematch
