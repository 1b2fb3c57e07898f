// Reads the body of a request within its limit.
#pragma once

#include <httplib.h>

#include <cstddef>
#include <optional>

#include "server/byte_budget.h"
#include "server/gate.h"
#include "server/http_message.h"
#include "server/problem.h"
#include "server/router.h"

namespace spherematch {

/// JSON documents are read whole and take some ten times their size as values.
inline constexpr std::size_t max_json_bytes = std::size_t{4} << 20;

/// What bounds all bodies together. A client may take its time to send, so bodies on their way count by what has come of them, and
/// only whole ones take one of the few places in which a mesh is read.
struct BodyBounds {
  Gate& receiving;     ///< bodies on their way, each of which takes a thread
  ByteBudget& memory;  ///< what has come of them, and whole ones until they are let go
  Gate& reading;       ///< whole meshes that are worked on
};

/// Why a body is refused unread: no or a false length, chunks, an encoding, too large. The library counts neither chunks nor
/// what it decompresses, so only plain bodies of a declared length are read.
[[nodiscard]] std::optional<ProblemError> refuse_body(const httplib::Request& request, Body kind, std::size_t max_bytes);

/// The bytes of the raw body, or of an upload the multipart field `file`. refuse_body() must have passed the request.
/// @throws ProblemError(bad_request) when the body ends early or the parts are malformed, ProblemError(invalid_parameter) for any
/// other field or a second file, ProblemError(overloaded) beyond the bounds
[[nodiscard]] RequestBody read_body(const httplib::Request& request, const httplib::ContentReader& reader, Body kind,
                                    const BodyBounds& bounds);

}  // namespace spherematch
