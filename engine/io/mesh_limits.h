// What every mesh reader checks in the same way: how large a mesh may be, and that its faces refer to its vertices.
#pragma once

#include <cstdint>
#include <string>

#include "engine/data/error.h"
#include "engine/data/parameters.h"

namespace spherematch {

/// Immutable, so safe to share between threads. Where a function takes a `source`, that is what knows the place in the file: a class
/// with `std::string place() const`, which starts a message, and `void fail(message) const`, which throws EngineError(malformed_mesh).
class MeshLimits {
 public:
  explicit MeshLimits(const ReadLimits& limits);

  /// The configured limit, as far as corners can be counted in 32 bits.
  [[nodiscard]] std::int64_t vertices() const { return vertices_; }
  [[nodiscard]] std::int64_t corners() const { return vertices_ * corners_per_vertex; }

  /// @throws EngineError(too_many_vertices)
  void check_vertices(std::int64_t count) const {
    if (count > vertices_) refuse_vertices(count);
  }

  /// @throws EngineError(too_many_vertices) with the place
  template <typename Source>
  void check_corners(std::int64_t count, const Source& source) const {
    if (count > corners()) refuse_corners(source.place());
  }

  /// For one face of `corners` corners after faces that have `before` of them in all.
  /// @throws EngineError(malformed_mesh), EngineError(too_many_vertices) with the place
  template <typename Source>
  void check_face(std::int64_t corners, std::int64_t before, const Source& source) const {
    if (corners < 3) source.fail("a face has " + std::to_string(corners) + " corners");
    if (corners > this->corners() - before) refuse_corners(source.place());
  }

 private:
  /// A closed triangle mesh has six corners for each vertex, twice as many when every face is there from both sides.
  static constexpr std::int64_t corners_per_vertex = 12;

  [[noreturn]] void refuse_vertices(std::int64_t count) const;
  [[noreturn]] void refuse_corners(const std::string& place) const;

  std::int64_t vertices_;
};

/// @throws EngineError(malformed_mesh) with the place, unless 0 <= index < vertices
template <typename Source>
std::int32_t checked_index(std::int64_t index, std::int64_t vertices, const Source& source) {
  if (index < 0 || index >= vertices)
    source.fail("vertex index " + std::to_string(index) + " is not in 0 to " + std::to_string(vertices - 1));
  return static_cast<std::int32_t>(index);
}

/// @throws EngineError(degenerate) when one of the counts is zero
void check_not_empty(std::int64_t vertices, std::int64_t faces);

}  // namespace spherematch
