#include "storage/blob_codec.h"

#include <gtest/gtest.h>

#include <limits>

#include "storage/blob_frame.h"
#include "storage/byte_stream.h"
#include "tests/storage/sample_shapes.h"

namespace spherematch {
namespace {

using testing::error_of;
using testing::same_bits;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Blob text_bytes(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

TEST(BlobCodec, RoundTripsUploads) {
  const std::vector<Blob> uploads{text_bytes("x"), text_bytes(std::string(100'000, '7')), text_bytes(""), Blob(3, std::byte{0})};
  for (const Blob& upload : uploads) EXPECT_EQ(decode_upload(encode_upload(upload)), upload);
}

TEST(BlobCodec, RoundTripsSurfaces) {
  for (const std::int32_t vertices : {4, 12, 5000}) {
    const Surface surface = testing::sample_surface(vertices);
    testing::expect_same(decode_surface(encode_surface(surface)), surface);
  }
}

TEST(BlobCodec, RoundTripsDecimatedSurfaces) {
  const Surface plain = testing::sample_surface(40);
  Surface surface = plain;
  surface.decimated = testing::sample_decimated(plain);
  const Blob blob = encode_surface(surface);
  const Surface decoded = decode_surface(blob);
  testing::expect_same(decoded, surface);
  ASSERT_TRUE(decoded.decimated.has_value());
  EXPECT_FALSE(decode_surface(encode_surface(plain)).decimated.has_value());

  const auto code = [&](auto change) {
    Surface changed = surface;
    change(*changed.decimated);
    const Blob wrong = encode_surface(changed);
    return error_of([&] { (void)decode_surface(wrong); });
  };
  EXPECT_EQ(code([](DecimatedMesh& d) { d.mesh.faces(2, 1) = static_cast<std::int32_t>(d.mesh.vertex_count()); }),
            StorageErrorCode::corrupt_blob);
  EXPECT_EQ(code([](DecimatedMesh& d) { d.places.back().face = static_cast<std::int32_t>(d.mesh.face_count()); }),
            StorageErrorCode::corrupt_blob);
  EXPECT_EQ(code([](DecimatedMesh& d) { d.places.front().face = -1; }), StorageErrorCode::corrupt_blob);
  EXPECT_EQ(code([](DecimatedMesh& d) { d.places.pop_back(); }), StorageErrorCode::corrupt_blob);
}

TEST(BlobCodec, RoundTripsSpheresBitByBit) {
  Points sphere(3, 3);
  sphere << 0.1, -0.0, nan, infinity, -infinity, std::numeric_limits<double>::denorm_min(), 1.0 / 3.0, 1e308, -nan;
  EXPECT_TRUE(same_bits(decode_sphere(encode_sphere(sphere)), sphere));
  const Points empty(0, 3);
  EXPECT_EQ(decode_sphere(encode_sphere(empty)).rows(), 0);
}

TEST(BlobCodec, RoundTripsSignals) {
  std::mt19937 random(3);
  std::vector<SignalGrid> signals{{"hks_1", testing::random_matrix<Eigen::MatrixXf>(random, 128, 128)},
                                  {"", testing::random_matrix<Eigen::MatrixXf>(random, 2, 3)},
                                  {"empty", Eigen::MatrixXf(0, 0)}};
  signals[1].values(0, 1) = std::numeric_limits<float>::quiet_NaN();
  signals[1].values(1, 2) = -0.0F;
  const auto decoded = decode_signals(encode_signals(signals));
  ASSERT_EQ(decoded.size(), signals.size());
  for (std::size_t i = 0; i < signals.size(); ++i) {
    EXPECT_EQ(decoded[i].name, signals[i].name);
    EXPECT_TRUE(same_bits(decoded[i].values, signals[i].values));
  }
  EXPECT_TRUE(decode_signals(encode_signals({})).empty());
}

TEST(BlobCodec, RoundTripsEigenbases) {
  std::mt19937 random(4);
  Eigen::VectorXd values = testing::random_matrix<Eigen::VectorXd>(random, 7, 1);
  values(0) = -0.0;
  Eigen::MatrixXf vectors = testing::random_matrix<Eigen::MatrixXf>(random, 31, 7);
  vectors(30, 6) = std::numeric_limits<float>::quiet_NaN();
  const StoredEigenbasis basis = decode_eigenbasis(encode_eigenbasis(values, vectors));
  EXPECT_TRUE(same_bits(basis.eigenvalues, values));
  EXPECT_TRUE(same_bits(basis.eigenvectors, vectors));
}

// What one release writes the next must read: these bytes were worked out by hand from the header's description.
TEST(BlobCodec, WritesLittleEndianBytes) {
  Points sphere(1, 3);
  sphere << 1.0, -2.0, 0.0;
  const Blob blob = encode_sphere(sphere);
  const std::vector<int> header{'S', 'M', 'B', '1', 1, 0, 3, 0, 28, 0, 0, 0, 0, 0, 0, 0};
  const std::vector<int> payload{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f, 0, 0, 0, 0, 0, 0, 0, 0xc0, 0, 0, 0, 0, 0, 0, 0, 0};
  ASSERT_EQ(blob.size(), blob_header_size + payload.size());
  for (std::size_t i = 0; i < header.size(); ++i) EXPECT_EQ(std::to_integer<int>(blob[i]), header[i]) << "offset " << i;
  for (std::size_t i = 0; i < payload.size(); ++i) EXPECT_EQ(std::to_integer<int>(blob[blob_header_size + i]), payload[i]) << i;
}

TEST(BlobCodec, RefusesAnotherKind) {
  const Blob sphere = encode_sphere(Points::Zero(2, 3));
  EXPECT_EQ(error_of([&] { (void)decode_upload(sphere); }), StorageErrorCode::corrupt_blob);
  EXPECT_EQ(error_of([&] { (void)decode_surface(sphere); }), StorageErrorCode::corrupt_blob);
  EXPECT_EQ(error_of([&] { (void)decode_signals(sphere); }), StorageErrorCode::corrupt_blob);
  EXPECT_EQ(error_of([&] { (void)decode_eigenbasis(sphere); }), StorageErrorCode::corrupt_blob);
  EXPECT_EQ(error_of([&] { (void)decode_sphere(encode_upload(sphere)); }), StorageErrorCode::corrupt_blob);
}

// Payloads whose frame is right but whose contents lie.

Blob sealed(Blob payload, BlobKind kind) {
  payload.insert(payload.begin(), blob_header_size, std::byte{0});
  seal_blob(payload, kind, BlobCompression::none);
  return payload;
}

TEST(BlobCodec, RefusesIndicesOutOfRange) {
  const auto code = [](auto change) {
    Surface surface = testing::sample_surface();
    change(surface);
    const Blob blob = encode_surface(surface);
    return error_of([&] { (void)decode_surface(blob); });
  };
  EXPECT_EQ(code([](Surface& s) { s.mesh.faces(3, 1) = 12; }), StorageErrorCode::corrupt_blob);
  EXPECT_EQ(code([](Surface& s) { s.mesh.faces(0, 0) = -1; }), StorageErrorCode::corrupt_blob);
  EXPECT_EQ(code([](Surface& s) { s.uploaded_corners(0, 2) = 15; }), StorageErrorCode::corrupt_blob);
  EXPECT_EQ(code([](Surface& s) { s.uploaded_corners(0, 2) = -2; }), StorageErrorCode::corrupt_blob);
  EXPECT_EQ(code([](Surface& s) { s.surface_vertex.back() = 12; }), StorageErrorCode::corrupt_blob);
  EXPECT_EQ(code([](Surface& s) { s.surface_vertex.front() = -2; }), StorageErrorCode::corrupt_blob);
}

TEST(BlobCodec, RefusesSizesBeyondTheBlobBeforeAllocating) {
  const auto payload = [](const std::vector<std::uint32_t>& numbers) {
    Blob bytes;
    ByteWriter(bytes).array(numbers.data(), numbers.size());
    return bytes;
  };
  constexpr std::uint32_t huge = 0xffffffff;
  const auto corrupt = StorageErrorCode::corrupt_blob;
  EXPECT_EQ(error_of([&] { (void)decode_sphere(sealed(payload({huge}), BlobKind::sphere)); }), corrupt);
  EXPECT_EQ(error_of([&] { (void)decode_eigenbasis(sealed(payload({0, huge, huge}), BlobKind::eigenbasis)); }), corrupt);
  EXPECT_EQ(error_of([&] { (void)decode_eigenbasis(sealed(payload({huge, 0, 0}), BlobKind::eigenbasis)); }), corrupt);
  EXPECT_EQ(error_of([&] { (void)decode_signals(sealed(payload({huge}), BlobKind::signals)); }), corrupt);
  EXPECT_EQ(error_of([&] { (void)decode_signals(sealed(payload({1, huge}), BlobKind::signals)); }), corrupt);
  EXPECT_EQ(error_of([&] { (void)decode_signals(sealed(payload({1, 0, 65536, 65536}), BlobKind::signals)); }), corrupt);
  std::vector<std::uint32_t> surface(13, 0);
  for (const std::size_t field : {0U, 1U, 2U}) {
    auto numbers = surface;
    numbers[field] = huge;
    EXPECT_EQ(error_of([&] { (void)decode_surface(sealed(payload(numbers), BlobKind::surface)); }), corrupt);
  }
}

TEST(BlobCodec, RefusesWhatFollowsTheContents) {
  Blob payload;
  ByteWriter(payload).number(std::uint32_t{0});
  EXPECT_EQ(decode_sphere(sealed(payload, BlobKind::sphere)).rows(), 0);
  payload.push_back(std::byte{0});
  EXPECT_EQ(error_of([&] { (void)decode_sphere(sealed(payload, BlobKind::sphere)); }), StorageErrorCode::corrupt_blob);
  EXPECT_EQ(error_of([&] { (void)decode_signals(sealed(payload, BlobKind::signals)); }), StorageErrorCode::corrupt_blob);
}

// Whatever the payload, decoding ends in a value or in corrupt_blob. Run under sanitizers this looks for passing the end.
TEST(BlobCodec, SurvivesArbitraryPayloads) {
  std::mt19937 random(5);
  const Surface surface = testing::sample_surface(4);
  Blob buffer;
  const Blob surface_blob = encode_surface(surface);
  const auto surface_payload = open_blob(surface_blob, BlobKind::surface, buffer);
  std::mt19937 values(6);
  const Blob signals = encode_signals({{"a", testing::random_matrix<Eigen::MatrixXf>(values, 2, 2)}});
  Blob unused;
  const auto signals_payload = open_blob(signals, BlobKind::signals, unused);
  int refused = 0;
  for (int round = 0; round < 4000; ++round) {
    const bool first = round % 2 == 0;
    const auto original = first ? surface_payload : signals_payload;
    Blob payload(original.begin(), original.end());
    for (int change = 0; change < 3; ++change) payload[random() % std::min<std::size_t>(payload.size(), 80)] = std::byte(random() & 255U);
    if (random() % 4 == 0) payload.resize(random() % payload.size());
    try {
      if (first) {
        (void)decode_surface(sealed(payload, BlobKind::surface));
      } else {
        (void)decode_signals(sealed(payload, BlobKind::signals));
      }
    } catch (const StorageError& error) {
      EXPECT_EQ(error.code(), StorageErrorCode::corrupt_blob);
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace spherematch
