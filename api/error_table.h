// SPDX-License-Identifier: MIT
// The one table of everything that an answer can complain of: code, wire string, HTTP status, title. docs/http.md lists each.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace spherematch::api {

enum class Code {
  // the request
  bad_request,
  invalid_parameter,
  unauthorized,
  forbidden,
  not_found,
  method_not_allowed,
  not_acceptable,
  length_required,
  payload_too_large,
  uri_too_long,
  unsupported_media_type,
  content_encoding,
  // the mesh
  malformed_mesh,
  unsupported_format,
  compressed_geometry,
  external_reference,
  too_many_vertices,
  degenerate,
  non_manifold,
  inconsistent_orientation,
  not_closed,
  disconnected,
  wrong_genus,
  parametrization_failed,
  // the array of a transfer
  malformed_array,
  length_mismatch,
  // the state of a shape
  shape_not_ready,
  shape_failed,
  precondition_failed,
  // the state of a job
  job_finished,
  // the server
  cancelled,
  overloaded,
  draining,
  not_ready,
  insufficient_storage,
  internal,
};

struct ErrorEntry {
  Code code;
  std::string_view wire;   ///< stable: clients branch on it
  int status;              ///< HTTP status
  std::string_view title;  ///< the same for every occurrence
  bool retryable;          ///< the same request may succeed later
};

/// Every code exactly once, in the order of the enumeration.
[[nodiscard]] std::span<const ErrorEntry> error_table();

[[nodiscard]] const ErrorEntry& entry_of(Code code);

[[nodiscard]] std::optional<Code> code_from_wire(std::string_view wire);

}  // namespace spherematch::api
