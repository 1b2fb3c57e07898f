// SPDX-License-Identifier: MIT
#include "api/error_table.h"

#include <array>

namespace spherematch::api {

namespace {

constexpr auto table = std::to_array<ErrorEntry>({
    {Code::bad_request, "bad-request", 400, "The request is not well-formed HTTP", false},
    {Code::invalid_parameter, "invalid-parameter", 400, "A parameter is unknown or out of range", false},
    {Code::unauthorized, "unauthorized", 401, "The request needs a key", false},
    {Code::forbidden, "forbidden", 403, "The key does not allow this", false},
    {Code::not_found, "not-found", 404, "There is no such resource", false},
    {Code::method_not_allowed, "method-not-allowed", 405, "The resource does not have this method", false},
    {Code::not_acceptable, "not-acceptable", 406, "No representation fits the Accept header", false},
    {Code::length_required, "length-required", 411, "The body needs a Content-Length", false},
    {Code::payload_too_large, "payload-too-large", 413, "The body is too large", false},
    {Code::uri_too_long, "uri-too-long", 414, "The request target is too long", false},
    {Code::unsupported_media_type, "unsupported-media-type", 415, "The body is not in a supported form", false},
    {Code::content_encoding, "content-encoding", 415, "Encoded bodies are not accepted", false},
    {Code::malformed_mesh, "malformed-mesh", 400, "The mesh file is malformed", false},
    {Code::unsupported_format, "unsupported-format", 415, "The mesh file is of no supported format", false},
    {Code::compressed_geometry, "compressed-geometry", 415, "The geometry is compressed", false},
    {Code::external_reference, "external-reference", 422, "The mesh is partly in another file", false},
    {Code::too_many_vertices, "too-many-vertices", 422, "The mesh has too many vertices", false},
    {Code::degenerate, "degenerate", 422, "The mesh is degenerate", false},
    {Code::non_manifold, "non-manifold", 422, "The mesh is not manifold", false},
    {Code::inconsistent_orientation, "inconsistent-orientation", 422, "The faces are not consistently oriented", false},
    {Code::not_closed, "not-closed", 422, "The surface is not closed", false},
    {Code::disconnected, "disconnected", 422, "The mesh has several components", false},
    {Code::wrong_genus, "wrong-genus", 422, "The surface is not a sphere", false},
    {Code::parametrization_failed, "parametrization-failed", 422, "No spherical parametrisation was found", false},
    {Code::malformed_array, "malformed-array", 400, "The array file is malformed", false},
    {Code::length_mismatch, "length-mismatch", 422, "The array has another length than the shape", false},
    {Code::shape_not_ready, "shape-not-ready", 409, "The shape is still being prepared", true},
    {Code::shape_failed, "shape-failed", 422, "The shape could not be prepared", false},
    {Code::precondition_failed, "precondition-failed", 412, "The resource has changed", false},
    {Code::job_finished, "job-finished", 409, "The job has ended", false},
    {Code::cancelled, "cancelled", 503, "The work was cancelled", true},
    {Code::overloaded, "overloaded", 503, "The server is busy", true},
    {Code::draining, "draining", 503, "The server is stopping", true},
    {Code::not_ready, "not-ready", 503, "The server is not ready", true},
    {Code::insufficient_storage, "insufficient-storage", 507, "The store is full", true},
    {Code::internal, "internal", 500, "The server failed", true},
});

constexpr bool indexed_by_code() {
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (static_cast<std::size_t>(table[i].code) != i) return false;
  }
  return table.size() == static_cast<std::size_t>(Code::internal) + 1;
}
static_assert(indexed_by_code(), "entry_of() indexes the table by the code");

}  // namespace

std::span<const ErrorEntry> error_table() { return table; }

const ErrorEntry& entry_of(Code code) { return table.at(static_cast<std::size_t>(code)); }

std::optional<Code> code_from_wire(std::string_view wire) {
  for (const ErrorEntry& entry : table) {
    if (entry.wire == wire) return entry.code;
  }
  return std::nullopt;
}

}  // namespace spherematch::api
