// The frame around every stored blob: what it is, which version of the codec wrote it, and whether it is intact.
//
// offset 0 magic "SMB1" | 4 codec version u16 | 6 kind u8 | 7 compression u8 (0 none, 1 zstd) | 8 payload size u64 (before
// compression) | 16 XXH3-64 u64 of the first 16 bytes and the stored payload | 24 payload. All integers little-endian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace spherematch {

/// The numbers are stored: never reuse one.
enum class BlobKind : std::uint8_t { upload = 1, surface = 2, sphere = 3, signals = 4, eigenbasis = 5, match = 6 };

enum class BlobCompression { none, where_it_helps };

inline constexpr std::uint16_t blob_codec_version = 1;
inline constexpr std::size_t blob_header_size = 24;
/// SQLite's default limit of one value is 10^9 bytes.
inline constexpr std::size_t max_blob_size = 999'000'000;

/// Turns `blob`, whose first blob_header_size bytes are free and are followed by the payload, into a framed blob in place.
/// @throws StorageError(too_large)
void seal_blob(std::vector<std::byte>& blob, BlobKind kind, BlobCompression compression);

/// The payload of a sealed blob: a view into `blob`, or into `buffer` where it had to be decompressed.
/// @throws StorageError(corrupt_blob, unknown_version)
[[nodiscard]] std::span<const std::byte> open_blob(std::span<const std::byte> blob, BlobKind kind, std::vector<std::byte>& buffer);

}  // namespace spherematch
