// Numbers out of the accessors of a glTF model, every reference checked. Internal to engine/io.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/data/tri_mesh.h"

namespace tinygltf {
class Model;
}

namespace spherematch {

/// A numbered part of a glTF file, for messages.
struct GltfPart {
  std::string_view kind;  ///< such as "node"
  std::int64_t index;

  /// "node 3: "
  [[nodiscard]] std::string place() const;
  /// @throws EngineError(malformed_mesh) always: place() and the message
  [[noreturn]] void fail(const std::string& message) const;
};

/// The number of positions, at least one: floats, or integers as KHR_mesh_quantization allows them, normalised or not. Their bytes are
/// there, except that what lies in no buffer view and is not among the sparse values is zero.
/// @throws EngineError(malformed_mesh) naming the accessor
[[nodiscard]] std::int64_t position_count(const tinygltf::Model& model, int accessor);

/// The number of indices, at least one, as position_count().
[[nodiscard]] std::int64_t index_count(const tinygltf::Model& model, int accessor);

/// Writes the positions to the rows of `points`, position_count() of them. They may be NaN or infinite.
/// @throws EngineError(malformed_mesh) as position_count() does, and for sparse values at elements that there are not
void read_positions(const tinygltf::Model& model, int accessor, Eigen::Ref<Points> points);

/// @throws EngineError(malformed_mesh) as read_positions() does
[[nodiscard]] std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor);

}  // namespace spherematch
