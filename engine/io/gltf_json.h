// Guards the JSON of a glTF file before a parser that trusts it gets to see it. Internal to engine/io.
#pragma once

#include <cstddef>
#include <span>

namespace spherematch {

/// Overwrites, in place, every member of an object that says nothing about geometry by an empty one, so that materials, images,
/// animations, extras, extensions and names are never parsed, decoded or copied. All other bytes stay where they are.
///
/// Checks what is left, for tinygltf 2.7 copies every value into structures of up to half a kilobyte, recurses over nested ones,
/// truncates integers to 32 bits, takes a negative or fractional one for absent, and copies the binary chunk for each buffer without a
/// `uri`: values nest at most 64 deep, all of them take at most 64 MiB and four times `file_size` in memory, every number but those of
/// a transform is an integer from 0 to 2^31 - 1, and at most one buffer has no `uri`. Whether the text is JSON in every detail is left
/// to the parser. `offset` is where the text stands in the file, for messages.
/// @throws EngineError(malformed_mesh) with the byte, EngineError(unsupported_format) when there is no `asset`
void reduce_gltf_json(std::span<char> json, std::size_t offset, std::size_t file_size);

}  // namespace spherematch
