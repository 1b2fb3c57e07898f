// What can go wrong inside the engine. The wire string and HTTP status of each code are in api/.
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace spherematch {

enum class ErrorCode {
  malformed_mesh,            ///< the bytes are not what their format promises
  unsupported_format,        ///< no reader recognises the bytes
  compressed_geometry,       ///< glTF geometry in a compressed form that is not read
  external_reference,        ///< the mesh is partly in another file
  too_many_vertices,         ///< more vertices than the configured limit
  degenerate,                ///< zero or non-finite area, or fewer than four usable vertices
  non_manifold,              ///< non-manifold edge or vertex (repair=none)
  inconsistent_orientation,  ///< neighbouring faces disagree, or the surface is not orientable
  not_closed,                ///< boundary loops (repair=none), or a hole that cannot be filled
  disconnected,              ///< more than one component (repair=none)
  wrong_genus,               ///< closed, but not a sphere
  parametrization_failed,    ///< no spherical parametrisation without flipped triangles was found
  malformed_array,           ///< the bytes are no array file, or of a kind that is not read
  cancelled,                 ///< the caller asked to stop
  invalid_parameter,         ///< a parameter struct failed validate()
};

/// Elements of the uploaded mesh that an error speaks of; at most 20 of each kind are listed.
struct OffendingElements {
  std::vector<std::int32_t> vertices;              ///< uploaded vertex indices
  std::vector<std::int32_t> faces;                 ///< uploaded face indices
  std::vector<std::array<std::int32_t, 2>> edges;  ///< pairs of uploaded vertex indices
};

/// Every failure that the engine reports on purpose. what() is a sentence for the user.
class EngineError : public std::runtime_error {
 public:
  EngineError(ErrorCode code, const std::string& detail, OffendingElements elements = {})
      : std::runtime_error(detail), code_(code), elements_(std::move(elements)) {}

  [[nodiscard]] ErrorCode code() const { return code_; }
  [[nodiscard]] const OffendingElements& elements() const { return elements_; }

 private:
  ErrorCode code_;
  OffendingElements elements_;
};

}  // namespace spherematch
