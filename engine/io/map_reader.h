// Maps in, and the truth to hold them against. Safe on untrusted bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/data/correspondence.h"

namespace spherematch {

/// Reads the arrays that encode_npz() writes, in any order and stored or deflated, as numpy.savez_compressed() has them too.
/// The arrays have one length n; indices are at least -1, weights are finite.
/// @throws EngineError(malformed_mesh) with the reason
[[nodiscard]] Correspondence decode_npz(std::span<const std::byte> bytes);

/// Reads a landmark list: vertex numbers from 1, separated by blanks or line ends. Returns them counted from 0.
/// @throws EngineError(malformed_mesh) with the line
[[nodiscard]] std::vector<std::int32_t> read_landmarks(std::string_view text);

/// Reads an index list as encode_text() writes it: for each source vertex the number of a target vertex, from 0, or -1 for none.
/// @throws EngineError(malformed_mesh) with the line
[[nodiscard]] std::vector<std::int32_t> read_indices(std::string_view text);

/// Reads an index list as encode_list_from_one() writes it. Returns the numbers counted from 0, -1 for none.
/// @throws EngineError(malformed_mesh) with the line
[[nodiscard]] std::vector<std::int32_t> read_list_from_one(std::string_view text);

}  // namespace spherematch
