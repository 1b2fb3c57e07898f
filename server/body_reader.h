// Reads the body of an upload, raw or multipart, within its limit.
#pragma once

#include <httplib.h>

#include <cstddef>
#include <optional>

#include "server/gate.h"
#include "server/http_message.h"
#include "server/problem.h"

namespace spherematch {

/// Why a body is refused unread: no or a false length, chunks, an encoding, too large. The library counts neither chunks nor
/// what it decompresses, so only plain bodies of a declared length are read.
[[nodiscard]] std::optional<ProblemError> refuse_body(const httplib::Request& request, std::size_t max_bytes);

/// The bytes of the raw body, or of the multipart field `file`. refuse_body() must have passed the request.
/// @throws ProblemError(bad_request) when the body ends early or the parts are malformed, ProblemError(invalid_parameter) for any
/// other field or a second file, ProblemError(overloaded) when too many uploads are being read
[[nodiscard]] Upload read_upload(const httplib::Request& request, const httplib::ContentReader& reader, Gate& uploads);

}  // namespace spherematch
