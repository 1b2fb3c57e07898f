#include "engine/io/map_writer.h"

#include <gtest/gtest.h>
#include <zip.h>

#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace spherematch {
namespace {

Correspondence some_map(Eigen::Index count) {
  Correspondence map;
  map.corners.resize(count, 3);
  map.bary.resize(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    map.vertex.push_back(static_cast<std::int32_t>(7 * i - 1));
    for (Eigen::Index k = 0; k < 3; ++k) map.corners(i, k) = static_cast<std::int32_t>(100 * i + k);
    map.bary.row(i) << 0.25F, 0.5F, 0.25F + static_cast<float>(i);
  }
  return map;
}

/// The parts of an NPY file of version 1.0.
struct Npy {
  std::string header;
  std::string numbers;
};

Npy parse_npy(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\0", 8));
  const std::size_t length = static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
  EXPECT_EQ((10 + length) % 64, 0U);
  EXPECT_EQ(bytes.at(9 + length), '\n');
  std::string header = bytes.substr(10, length);
  header.erase(header.find_last_not_of(" \n") + 1);
  return {header, bytes.substr(10 + length)};
}

template <typename Number>
std::vector<Number> numbers_of(const Npy& npy) {
  std::vector<Number> numbers(npy.numbers.size() / sizeof(Number));
  if (!numbers.empty()) std::memcpy(numbers.data(), npy.numbers.data(), numbers.size() * sizeof(Number));
  return numbers;
}

struct Entry {
  std::string name;
  std::string content;
  bool stored = false;
};

std::vector<Entry> unzip(const std::string& bytes) {
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, nullptr);
  const std::unique_ptr<zip_t, int (*)(zip_t*)> archive(zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, nullptr), zip_close);
  if (!archive) {
    zip_source_free(source);
    ADD_FAILURE() << "not a zip archive";
    return {};
  }
  std::vector<Entry> entries;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive.get(), 0); ++i) {
    zip_stat_t status;
    EXPECT_EQ(zip_stat_index(archive.get(), static_cast<zip_uint64_t>(i), 0, &status), 0);
    Entry entry{status.name, std::string(status.size, '\0'), status.comp_method == ZIP_CM_STORE};
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen_index(archive.get(), static_cast<zip_uint64_t>(i), 0),
                                                                 zip_fclose);
    EXPECT_EQ(zip_fread(file.get(), entry.content.data(), status.size), static_cast<zip_int64_t>(status.size));
    entries.push_back(std::move(entry));
  }
  return entries;
}

TEST(MapWriter, NpyHoldsTheVertices) {
  const Correspondence map = some_map(5);
  const Npy npy = parse_npy(encode_npy(map));
  EXPECT_EQ(npy.header, "{'descr': '<i4', 'fortran_order': False, 'shape': (5,), }");
  EXPECT_EQ(numbers_of<std::int32_t>(npy), map.vertex);
}

TEST(MapWriter, NpyHoldsPoints) {
  Points points(2, 3);
  points << 1.0 / 3, -2, 1e-300, 4, std::numeric_limits<double>::quiet_NaN(), 6;
  const Npy npy = parse_npy(encode_npy(points));
  EXPECT_EQ(npy.header, "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }");
  const std::vector<double> numbers = numbers_of<double>(npy);
  ASSERT_EQ(numbers.size(), 6U);
  EXPECT_EQ(std::memcmp(numbers.data(), points.data(), 6 * sizeof(double)), 0);
}

TEST(MapWriter, TextHasAnIndexPerLine) {
  EXPECT_EQ(encode_text(some_map(3)), "-1\n6\n13\n");
  EXPECT_EQ(encode_text(some_map(0)), "");
  EXPECT_EQ(encode_list_from_one(some_map(3)), "0\n7\n14\n");
  EXPECT_EQ(encode_list_from_one(some_map(0)), "");
}

TEST(MapWriter, NpzHoldsTheThreeArraysStored) {
  for (const Eigen::Index count : {0, 1, 1000}) {
    const Correspondence map = some_map(count);
    const std::vector<Entry> entries = unzip(encode_npz(map));
    ASSERT_EQ(entries.size(), 3U);
    for (const Entry& entry : entries) EXPECT_TRUE(entry.stored) << entry.name;
    const std::string n = std::to_string(count);

    EXPECT_EQ(entries[0].name, "vertex.npy");
    EXPECT_EQ(entries[0].content, encode_npy(map));

    EXPECT_EQ(entries[1].name, "corners.npy");
    const Npy corners = parse_npy(entries[1].content);
    EXPECT_EQ(corners.header, "{'descr': '<i4', 'fortran_order': False, 'shape': (" + n + ", 3), }");
    EXPECT_EQ(numbers_of<std::int32_t>(corners), std::vector<std::int32_t>(map.corners.data(), map.corners.data() + map.corners.size()));

    EXPECT_EQ(entries[2].name, "bary.npy");
    const Npy bary = parse_npy(entries[2].content);
    EXPECT_EQ(bary.header, "{'descr': '<f4', 'fortran_order': False, 'shape': (" + n + ", 3), }");
    EXPECT_EQ(numbers_of<float>(bary), std::vector<float>(map.bary.data(), map.bary.data() + map.bary.size()));
  }
}

TEST(MapWriter, NpzHoldsTheQualityThatIsGiven) {
  const VertexQuality quality{.distortion = {0.5F, 0}, .confidence = {0.75F, 0}};
  const std::vector<Entry> whole = unzip(encode_npz(some_map(2), quality));
  ASSERT_EQ(whole.size(), 5U);
  EXPECT_EQ(whole[3].name, "confidence.npy");
  EXPECT_EQ(parse_npy(whole[3].content).header, "{'descr': '<f4', 'fortran_order': False, 'shape': (2,), }");
  EXPECT_EQ(numbers_of<float>(parse_npy(whole[3].content)), quality.confidence);
  EXPECT_EQ(whole[4].name, "distortion.npy");
  EXPECT_EQ(numbers_of<float>(parse_npy(whole[4].content)), quality.distortion);

  const VertexQuality reverse_quality{.distortion = {1, 2, 3}, .confidence = {}};
  const std::vector<Entry> both = unzip(encode_npz(some_map(2), some_map(3), quality, reverse_quality));
  ASSERT_EQ(both.size(), 9U);
  EXPECT_EQ(both[3].content, whole[3].content);
  EXPECT_EQ(both[8].name, "reverse_distortion.npy");
  EXPECT_EQ(numbers_of<float>(parse_npy(both[8].content)), reverse_quality.distortion);
}

TEST(MapWriter, BytesDependOnTheMapAlone) {
  const std::string bytes = encode_npz(some_map(10));
  EXPECT_EQ(bytes, encode_npz(some_map(10)));
  // The modification time and date of the first entry, at bytes 10 to 13 of its header: midnight of the first of January 1980.
  EXPECT_EQ(bytes.substr(0, 4), "PK\x03\x04");
  EXPECT_EQ(bytes.substr(10, 4), std::string("\0\0\x21\0", 4));
}

}  // namespace
}  // namespace spherematch
