#include "storage/blob_frame.h"

#include <xxhash.h>
#include <zstd.h>

#include <memory>
#include <string>

#include "storage/byte_stream.h"
#include "storage/error.h"

namespace spherematch {
namespace {

constexpr std::uint32_t magic = 0x31424d53;  // "SMB1"
constexpr std::size_t checksum_offset = 16;
constexpr std::uint8_t compression_none = 0;
constexpr std::uint8_t compression_zstd = 1;
// Level 1: level 3 packs OFF uploads between 6 % better and 5 % worse, in about twice the time.
constexpr int zstd_level = 1;

[[noreturn]] void corrupt(const std::string& what) { throw StorageError(StorageErrorCode::corrupt_blob, what); }

struct HashStateDeleter {
  void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
};

std::uint64_t checksum(std::span<const std::byte> blob) {
  const std::unique_ptr<XXH3_state_t, HashStateDeleter> state(XXH3_createState());
  if (state == nullptr) throw std::bad_alloc();
  XXH3_64bits_reset(state.get());
  XXH3_64bits_update(state.get(), blob.data(), checksum_offset);
  XXH3_64bits_update(state.get(), blob.data() + blob_header_size, blob.size() - blob_header_size);
  return XXH3_64bits_digest(state.get());
}

/// The compressed payload behind an empty header, or nothing where it would not spare a tenth.
std::vector<std::byte> compressed(std::span<const std::byte> payload) {
  std::vector<std::byte> out(blob_header_size + ZSTD_compressBound(payload.size()));
  const std::size_t size =
      ZSTD_compress(out.data() + blob_header_size, out.size() - blob_header_size, payload.data(), payload.size(), zstd_level);
  if (ZSTD_isError(size) != 0U) throw std::bad_alloc();  // the only way a compression into enough room fails
  if (size > payload.size() - payload.size() / 10) return {};
  out.resize(blob_header_size + size);
  out.shrink_to_fit();
  return out;
}

std::span<const std::byte> decompressed(std::span<const std::byte> stored, std::uint64_t size, std::vector<std::byte>& buffer) {
  // Asked first, so that the frame's size is believed only where zstd's own header says the same.
  if (ZSTD_getFrameContentSize(stored.data(), stored.size()) != size) corrupt("a stored blob's compressed size contradicts its header");
  buffer.resize(size);
  const std::size_t result = ZSTD_decompress(buffer.data(), buffer.size(), stored.data(), stored.size());
  if (ZSTD_isError(result) != 0U || result != size) corrupt("a stored blob cannot be decompressed");
  return buffer;
}

}  // namespace

void seal_blob(std::vector<std::byte>& blob, BlobKind kind, BlobCompression compression) {
  const std::uint64_t payload_size = blob.size() - blob_header_size;
  if (blob.size() > max_blob_size) {
    throw StorageError(StorageErrorCode::too_large, "the store keeps at most " + std::to_string(max_blob_size) +
                                                        " bytes in one piece, not " + std::to_string(blob.size()));
  }
  std::uint8_t used = compression_none;
  if (compression == BlobCompression::where_it_helps) {
    std::vector<std::byte> smaller = compressed(std::span(blob).subspan(blob_header_size));
    if (!smaller.empty()) {
      blob = std::move(smaller);
      used = compression_zstd;
    }
  }
  store_little_endian(magic, blob.data());
  store_little_endian(blob_codec_version, blob.data() + 4);
  store_little_endian(static_cast<std::uint8_t>(kind), blob.data() + 6);
  store_little_endian(used, blob.data() + 7);
  store_little_endian(payload_size, blob.data() + 8);
  store_little_endian(checksum(blob), blob.data() + checksum_offset);
}

std::span<const std::byte> open_blob(std::span<const std::byte> blob, BlobKind kind, std::vector<std::byte>& buffer) {
  if (blob.size() < blob_header_size) corrupt("a stored blob is shorter than its header");
  if (load_little_endian<std::uint32_t>(blob.data()) != magic) corrupt("a stored blob does not begin like one");
  if (load_little_endian<std::uint64_t>(blob.data() + checksum_offset) != checksum(blob)) corrupt("a stored blob fails its checksum");
  const auto version = load_little_endian<std::uint16_t>(blob.data() + 4);
  if (version != blob_codec_version) {
    throw StorageError(StorageErrorCode::unknown_version, "a stored blob has codec version " + std::to_string(version) +
                                                              ", this release reads version " + std::to_string(blob_codec_version));
  }
  if (load_little_endian<std::uint8_t>(blob.data() + 6) != static_cast<std::uint8_t>(kind)) corrupt("a stored blob is of another kind");
  const auto compression = load_little_endian<std::uint8_t>(blob.data() + 7);
  const auto size = load_little_endian<std::uint64_t>(blob.data() + 8);
  const auto stored = blob.subspan(blob_header_size);
  if (size > max_blob_size) corrupt("a stored blob claims an impossible size");
  if (compression == compression_zstd) return decompressed(stored, size, buffer);
  if (compression != compression_none) corrupt("a stored blob is compressed in an unknown way");
  if (size != stored.size()) corrupt("a stored blob's size contradicts its header");
  return stored;
}

}  // namespace spherematch
