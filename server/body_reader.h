// Reads the body of an upload, raw or multipart, within its limit.
#pragma once

#include <httplib.h>

#include <cstddef>
#include <optional>

#include "server/byte_budget.h"
#include "server/gate.h"
#include "server/http_message.h"
#include "server/problem.h"

namespace spherematch {

/// What bounds all uploads together. A client may take its time to send, so bodies on their way count by what has come of them, and
/// only whole ones take one of the few places in which a mesh is read.
struct UploadBounds {
  Gate& receiving;     ///< bodies on their way, each of which takes a thread
  ByteBudget& memory;  ///< what has come of them, and whole ones until they are let go
  Gate& reading;       ///< whole ones that are worked on
};

/// Why a body is refused unread: no or a false length, chunks, an encoding, too large. The library counts neither chunks nor
/// what it decompresses, so only plain bodies of a declared length are read.
[[nodiscard]] std::optional<ProblemError> refuse_body(const httplib::Request& request, std::size_t max_bytes);

/// The bytes of the raw body, or of the multipart field `file`. refuse_body() must have passed the request.
/// @throws ProblemError(bad_request) when the body ends early or the parts are malformed, ProblemError(invalid_parameter) for any
/// other field or a second file, ProblemError(overloaded) beyond the bounds
[[nodiscard]] Upload read_upload(const httplib::Request& request, const httplib::ContentReader& reader, const UploadBounds& bounds);

}  // namespace spherematch
