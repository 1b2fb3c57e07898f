// A match result in each representation.
#pragma once

#include <string>
#include <string_view>

#include "api/types.h"
#include "server/match_service.h"

namespace spherematch {

/// The arrays of an answer. Files have their map whole, and of these take confidence and distortion alone (routes_match.cpp).
struct MatchFields {
  bool vertex = true;
  bool corners = false;
  bool bary = false;
  bool confidence = false;
  bool distortion = false;

  /// Whether they need what is not in a match result.
  [[nodiscard]] bool quality() const { return confidence || distortion; }
};

/// "vertex,bary" and the like; an empty text selects none. @throws ProblemError(invalid_parameter)
[[nodiscard]] MatchFields parse_fields(std::string_view text);

/// The same text for the same selection, whatever its order.
[[nodiscard]] std::string canonical(const MatchFields& fields);

/// Both shapes of a query, where an answer needs them.
struct MatchedShapes {
  ShapePointer source, target;
};

/// What to think of a map between these shapes. What the fields do not ask for stays empty, and the shapes may be null where they ask for
/// neither.
[[nodiscard]] VertexQuality quality_of(const Correspondence& map, const MatchFields& fields, const EnginePort& engine,
                                       const ShapePointer& source, const ShapePointer& target);

/// With the reverse map where the query asks for both. Fields of quality need the shapes.
[[nodiscard]] api::Match match_of(const MatchQuery& query, const MatchAnswer& answer, const MatchFields& fields, std::int32_t n_tgt,
                                  const EnginePort& engine, const MatchedShapes& shapes = {});

}  // namespace spherematch
