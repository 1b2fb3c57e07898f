#include "storage/blob_frame.h"

#include <gtest/gtest.h>
#include <xxhash.h>

#include "storage/blob_codec.h"
#include "storage/byte_stream.h"
#include "tests/storage/sample_shapes.h"

namespace spherematch {
namespace {

using testing::error_of;

std::vector<Blob> every_kind() {
  const PreprocessedShape shape = testing::sample_prepared(testing::sample_surface(4), 1, 2, 2);
  const Blob upload(40, std::byte{'a'});
  return {encode_upload(upload), encode_surface(shape.surface), encode_sphere(shape.sphere), encode_signals(shape.signals),
          encode_eigenbasis(shape.eigenvalues, shape.eigenvectors)};
}

void decode(std::size_t kind, const Blob& blob) {
  switch (kind) {
    case 0:
      (void)decode_upload(blob);
      break;
    case 1:
      (void)decode_surface(blob);
      break;
    case 2:
      (void)decode_sphere(blob);
      break;
    case 3:
      (void)decode_signals(blob);
      break;
    default:
      (void)decode_eigenbasis(blob);
  }
}

TEST(BlobFrame, DetectsEveryChangedByte) {
  const auto blobs = every_kind();
  for (std::size_t kind = 0; kind < blobs.size(); ++kind) {
    ASSERT_NO_THROW(decode(kind, blobs[kind]));
    for (std::size_t i = 0; i < blobs[kind].size(); ++i) {
      for (const int mask : {1, 128, 255}) {
        Blob damaged = blobs[kind];
        damaged[i] ^= static_cast<std::byte>(mask);
        EXPECT_EQ(error_of([&] { decode(kind, damaged); }), StorageErrorCode::corrupt_blob) << "kind " << kind << " byte " << i;
      }
    }
  }
}

TEST(BlobFrame, DetectsEveryTruncationAndExtension) {
  const auto blobs = every_kind();
  for (std::size_t kind = 0; kind < blobs.size(); ++kind) {
    for (std::size_t size = 0; size < blobs[kind].size(); ++size) {
      const Blob cut(blobs[kind].begin(), blobs[kind].begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_EQ(error_of([&] { decode(kind, cut); }), StorageErrorCode::corrupt_blob) << "kind " << kind << " size " << size;
    }
    Blob longer = blobs[kind];
    longer.push_back(std::byte{0});
    EXPECT_EQ(error_of([&] { decode(kind, longer); }), StorageErrorCode::corrupt_blob);
  }
}

/// A frame with a right checksum around whatever its header says.
Blob with_right_checksum(Blob blob) {
  Blob hashed(blob.begin(), blob.begin() + 16);
  hashed.insert(hashed.end(), blob.begin() + blob_header_size, blob.end());
  store_little_endian(std::uint64_t{XXH3_64bits(hashed.data(), hashed.size())}, blob.data() + 16);
  return blob;
}

TEST(BlobFrame, ChecksumIsOfHeaderAndPayload) {
  for (const Blob& blob : every_kind()) EXPECT_EQ(with_right_checksum(blob), blob);
}

TEST(BlobFrame, NamesAnUnknownVersion) {
  Blob blob = encode_sphere(Points::Zero(1, 3));
  store_little_endian(static_cast<std::uint16_t>(blob_codec_version + 1), blob.data() + 4);
  EXPECT_EQ(error_of([&] { (void)decode_sphere(with_right_checksum(blob)); }), StorageErrorCode::unknown_version);
}

TEST(BlobFrame, RefusesHeadersThatLie) {
  const Blob plain = encode_sphere(Points::Zero(1, 3));
  const Blob packed = encode_upload(Blob(10'000, std::byte{'a'}));
  ASSERT_LT(packed.size(), 1000U);
  const auto code_with = [](Blob blob, std::size_t offset, auto value) {
    store_little_endian(value, blob.data() + offset);
    blob = with_right_checksum(std::move(blob));
    return error_of([&] { decode(std::to_integer<std::size_t>(blob[6]) - 1, blob); });
  };
  const auto corrupt = StorageErrorCode::corrupt_blob;
  EXPECT_EQ(code_with(plain, 7, std::uint8_t{9}), corrupt);                             // a compression that does not exist
  EXPECT_EQ(code_with(plain, 7, std::uint8_t{1}), corrupt);                             // plain bytes called compressed
  EXPECT_EQ(code_with(packed, 7, std::uint8_t{0}), corrupt);                            // compressed bytes called plain
  EXPECT_EQ(code_with(plain, 8, std::uint64_t{29}), corrupt);                           // one byte too many
  EXPECT_EQ(code_with(packed, 8, std::uint64_t{9'999}), corrupt);                       // less than it unpacks to
  EXPECT_EQ(code_with(packed, 8, std::uint64_t{10'001}), corrupt);                      // more than it unpacks to
  EXPECT_EQ(code_with(packed, 8, ~std::uint64_t{0}), corrupt);                          // more than any blob
  EXPECT_EQ(code_with(packed, packed.size() - 4, std::uint32_t{0xffffffff}), corrupt);  // damaged before the checksum was made
}

TEST(BlobFrame, CompressesOnlyWhereItHelps) {
  std::mt19937 random(7);
  Blob noise(10'000);
  for (std::byte& byte : noise) byte = static_cast<std::byte>(random() & 255U);
  EXPECT_EQ(encode_upload(noise).size(), noise.size() + blob_header_size);
  EXPECT_LT(encode_upload(Blob(10'000, std::byte{'a'})).size(), 200U);
}

TEST(BlobFrame, RefusesWhatTheStoreCannotKeep) {
  Blob blob(max_blob_size + 1);
  EXPECT_EQ(error_of([&] { seal_blob(blob, BlobKind::upload, BlobCompression::where_it_helps); }), StorageErrorCode::too_large);
}

}  // namespace
}  // namespace spherematch
