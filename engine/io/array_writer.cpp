#include "engine/io/array_writer.h"

#include <zip.h>

#include <array>
#include <bit>
#include <memory>
#include <stdexcept>

namespace spherematch {

namespace {

static_assert(std::endian::native == std::endian::little, "callers name little-endian types for their numbers");

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

std::string shape_text(std::span<const std::int64_t> shape) {
  std::string text;
  for (const std::int64_t length : shape) text.append(text.empty() ? "" : ", ").append(std::to_string(length));
  return shape.size() == 1 ? text + ',' : text;
}

}  // namespace

std::string encode_npy(std::string_view dtype, std::span<const std::int64_t> shape, std::span<const std::byte> items) {
  // Magic, header length, a Python dict padded so that the numbers start at a multiple of 64.
  std::string header = "{'descr': '" + std::string(dtype) + "', 'fortran_order': False, 'shape': (" + shape_text(shape) + "), }";
  constexpr std::size_t preamble = 10;
  header.append(63 - (preamble + header.size()) % 64, ' ');
  header += '\n';
  std::string npy = "\x93NUMPY";
  npy.reserve(preamble + header.size() + items.size());
  npy += '\x01';
  npy += '\0';
  npy += static_cast<char>(header.size() & 0xFF);
  npy += static_cast<char>(header.size() >> 8);
  npy += header;
  npy.append(reinterpret_cast<const char*>(items.data()), items.size());
  return npy;
}

std::string encode_npy(const Array& array) { return encode_npy(array.dtype, array.shape, std::as_bytes(std::span(array.bytes))); }

std::string encode_npz(std::span<const NamedArray> arrays) {
  const Source file(zip_source_buffer_create(nullptr, 0, 0, nullptr));
  if (!file) fail("buffer");
  zip_source_keep(file.get());  // The archive takes one reference; the other reads the bytes afterwards.
  Archive archive(zip_open_from_source(file.get(), ZIP_TRUNCATE, nullptr));
  if (!archive) {
    zip_source_free(file.get());
    fail("create");
  }
  for (const NamedArray& array : arrays) add_stored(archive.get(), (array.name + ".npy").c_str(), array.npy);
  if (zip_close(archive.get()) != 0) fail("close");
  [[maybe_unused]] const zip_t* closed = archive.release();
  return contents(file.get());
}

}  // namespace spherematch
