#include "engine/io/map_writer.h"

#include <zip.h>

#include <array>
#include <bit>
#include <charconv>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace spherematch {

namespace {

static_assert(std::endian::native == std::endian::little, "NPY headers below promise little-endian numbers");

/// NPY version 1.0: magic, header length, a Python dict padded so that the numbers start at a multiple of 64.
std::string encode_array(std::string_view type, Eigen::Index rows, Eigen::Index columns, const void* numbers, std::size_t bytes) {
  std::string shape = std::to_string(rows) + ',';
  if (columns > 0) shape += ' ' + std::to_string(columns);
  std::string header = "{'descr': '" + std::string(type) + "', 'fortran_order': False, 'shape': (" + shape + "), }";
  constexpr std::size_t preamble = 10;
  header.append(63 - (preamble + header.size()) % 64, ' ');
  header += '\n';
  std::string npy = "\x93NUMPY";
  npy += '\x01';
  npy += '\0';
  npy += static_cast<char>(header.size() & 0xFF);
  npy += static_cast<char>(header.size() >> 8);
  npy += header;
  if (bytes > 0) npy.append(static_cast<const char*>(numbers), bytes);
  return npy;
}

[[noreturn]] void fail(const char* step) { throw std::runtime_error(std::string("writing a zip archive failed: ") + step); }

struct FreeSource {
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};
struct DiscardArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Source = std::unique_ptr<zip_source_t, FreeSource>;
using Archive = std::unique_ptr<zip_t, DiscardArchive>;

/// `content` must live until the archive is closed.
void add_stored(zip_t* archive, const char* name, std::string_view content) {
  Source source(zip_source_buffer(archive, content.data(), content.size(), 0));
  if (!source) fail(name);
  const zip_int64_t index = zip_file_add(archive, name, source.get(), ZIP_FL_ENC_UTF_8);
  if (index < 0) fail(name);
  [[maybe_unused]] const zip_source_t* owned_by_archive = source.release();
  const auto entry = static_cast<zip_uint64_t>(index);
  constexpr zip_uint16_t midnight = 0;
  constexpr zip_uint16_t first_of_january_1980 = 0x21;
  if (zip_set_file_compression(archive, entry, ZIP_CM_STORE, 0) != 0) fail(name);
  if (zip_file_set_dostime(archive, entry, midnight, first_of_january_1980, 0) != 0) fail(name);
}

std::string contents(zip_source_t* source) {
  zip_stat_t status;
  zip_stat_init(&status);
  if (zip_source_stat(source, &status) != 0 || (status.valid & ZIP_STAT_SIZE) == 0) fail("stat");
  std::string bytes(status.size, '\0');
  if (zip_source_open(source) != 0) fail("open");
  const zip_int64_t read = zip_source_read(source, bytes.data(), bytes.size());
  zip_source_close(source);
  if (read != static_cast<zip_int64_t>(bytes.size())) fail("read");
  return bytes;
}

/// A file's name in the archive and its bytes.
using NamedArray = std::pair<std::string, std::string>;

void add_map(std::vector<NamedArray>& arrays, const std::string& prefix, const Correspondence& map) {
  const auto bytes_of = [](const auto& matrix) { return static_cast<std::size_t>(matrix.size()) * sizeof(matrix.data()[0]); };
  arrays.emplace_back(prefix + "vertex.npy", encode_npy(map));
  arrays.emplace_back(prefix + "corners.npy", encode_array("<i4", map.corners.rows(), 3, map.corners.data(), bytes_of(map.corners)));
  arrays.emplace_back(prefix + "bary.npy", encode_array("<f4", map.bary.rows(), 3, map.bary.data(), bytes_of(map.bary)));
}

std::string zip(const std::vector<NamedArray>& files) {
  const Source file(zip_source_buffer_create(nullptr, 0, 0, nullptr));
  if (!file) fail("buffer");
  zip_source_keep(file.get());  // The archive takes one reference; the other reads the bytes afterwards.
  Archive archive(zip_open_from_source(file.get(), ZIP_TRUNCATE, nullptr));
  if (!archive) {
    zip_source_free(file.get());
    fail("create");
  }
  for (const auto& [name, bytes] : files) add_stored(archive.get(), name.c_str(), bytes);
  if (zip_close(archive.get()) != 0) fail("close");
  [[maybe_unused]] const zip_t* closed = archive.release();
  return contents(file.get());
}

}  // namespace

std::string encode_npy(const Correspondence& map) {
  const auto count = static_cast<Eigen::Index>(map.vertex.size());
  return encode_array("<i4", count, 0, map.vertex.data(), map.vertex.size() * sizeof(std::int32_t));
}

std::string encode_npy(const Points& points) {
  return encode_array("<f8", points.rows(), 3, points.data(), static_cast<std::size_t>(points.size()) * sizeof(double));
}

std::string encode_text(const Correspondence& map) {
  std::string text;
  text.reserve(map.vertex.size() * 7);
  std::array<char, 16> digits{};
  for (const std::int32_t vertex : map.vertex) {
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), vertex);
    text.append(digits.data(), result.ptr);
    text += '\n';
  }
  return text;
}

std::string encode_npz(const Correspondence& map) {
  std::vector<NamedArray> arrays;
  add_map(arrays, "", map);
  return zip(arrays);
}

std::string encode_npz(const Correspondence& map, const Correspondence& reverse) {
  std::vector<NamedArray> arrays;
  add_map(arrays, "", map);
  add_map(arrays, "reverse_", reverse);
  return zip(arrays);
}

}  // namespace spherematch
