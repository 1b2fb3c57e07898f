#include "engine/io/map_reader.h"

#include <zip.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>

#include "engine/data/error.h"
#include "engine/io/text_scanner.h"

namespace spherematch {

namespace {

[[noreturn]] void fail(const std::string& reason) { throw EngineError(ErrorCode::malformed_mesh, "the map is not usable: " + reason); }

struct CloseFile {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
struct DiscardArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Archive = std::unique_ptr<zip_t, DiscardArchive>;

Archive open_archive(std::span<const std::byte> bytes) {
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, nullptr);
  if (source == nullptr) fail("no memory for its archive");
  Archive archive(zip_open_from_source(source, ZIP_RDONLY, nullptr));
  if (!archive) {
    zip_source_free(source);
    fail("it is not an NPZ archive");
  }
  return archive;
}

std::string read_entry(zip_t* archive, const std::string& name) {
  // Far above any map, far below what a compressed archive could claim.
  constexpr zip_uint64_t most_bytes = zip_uint64_t{1} << 30;
  zip_stat_t status;
  zip_stat_init(&status);
  if (zip_stat(archive, name.c_str(), 0, &status) != 0) fail("it has no array " + name);
  if ((status.valid & ZIP_STAT_SIZE) == 0 || status.size > most_bytes) fail("its array " + name + " is too large");
  const std::unique_ptr<zip_file_t, CloseFile> file(zip_fopen(archive, name.c_str(), 0));
  std::string bytes(status.size, '\0');
  // The checksum is looked at only when reading meets the end.
  char beyond = 0;
  if (!file || zip_fread(file.get(), bytes.data(), bytes.size()) != static_cast<zip_int64_t>(bytes.size()) ||
      zip_fread(file.get(), &beyond, 1) != 0)
    fail("its array " + name + " cannot be read");
  return bytes;
}

/// The value of `key` in the header's dictionary, up to `end`.
std::string_view header_value(std::string_view header, std::string_view key, char end) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) return {};
  const std::string_view rest = header.substr(at + key.size());
  return rest.substr(0, rest.find(end));
}

/// Copies an NPY array of the given type and number of columns (0 for a plain list) to `numbers`, a vector of its type.
template <typename Number>
std::vector<Number> read_array(zip_t* archive, const std::string& name, std::string_view type, std::size_t columns) {
  const std::string bytes = read_entry(archive, name + ".npy");
  constexpr std::size_t preamble = 10;
  if (bytes.size() < preamble || !bytes.starts_with("\x93NUMPY\x01")) fail("its array " + name + " is not NPY of version 1");
  const std::size_t header_size =
      static_cast<unsigned char>(bytes[8]) + 256 * static_cast<std::size_t>(static_cast<unsigned char>(bytes[9]));
  if (bytes.size() < preamble + header_size) fail("its array " + name + " ends early");
  const std::string_view header = std::string_view(bytes).substr(preamble, header_size);
  if (header_value(header, "'descr': '", '\'') != type || header.find("'fortran_order': False") == std::string_view::npos)
    fail("its array " + name + " is not " + std::string(type) + " in C order");
  const std::string_view shape = header_value(header, "'shape': (", ')');
  const std::string expected_tail = columns == 0 ? "," : ", " + std::to_string(columns);
  const std::size_t row_bytes = sizeof(Number) * std::max<std::size_t>(columns, 1);
  const std::size_t rows = (bytes.size() - preamble - header_size) / row_bytes;
  if (shape != std::to_string(rows) + expected_tail || bytes.size() != preamble + header_size + rows * row_bytes)
    fail("its array " + name + " has another shape than (n" + expected_tail + ")");
  std::vector<Number> numbers(rows * std::max<std::size_t>(columns, 1));
  if (rows > 0) std::memcpy(numbers.data(), bytes.data() + preamble + header_size, rows * row_bytes);
  return numbers;
}

}  // namespace

Correspondence decode_npz(std::span<const std::byte> bytes) {
  const Archive archive = open_archive(bytes);
  Correspondence map;
  map.vertex = read_array<std::int32_t>(archive.get(), "vertex", "<i4", 0);
  const auto corners = read_array<std::int32_t>(archive.get(), "corners", "<i4", 3);
  const auto bary = read_array<float>(archive.get(), "bary", "<f4", 3);
  if (corners.size() != 3 * map.vertex.size() || bary.size() != corners.size()) fail("its arrays differ in length");
  for (const std::int32_t vertex : map.vertex)
    if (vertex < -1) fail("it has the index " + std::to_string(vertex));
  for (const std::int32_t corner : corners)
    if (corner < -1) fail("it has the index " + std::to_string(corner));
  for (const float weight : bary)
    if (!std::isfinite(weight)) fail("it has a weight that is not finite");
  const auto rows = static_cast<Eigen::Index>(map.vertex.size());
  map.corners = Eigen::Map<const Triangles>(corners.data(), rows, 3);
  map.bary = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(bary.data(), rows, 3);
  return map;
}

namespace {

/// Whole numbers from `least` on, separated by blanks or line ends; `rule` says what a smaller one breaks.
std::vector<std::int32_t> read_numbers(std::string_view text, std::int64_t least, const char* rule) {
  std::vector<std::int32_t> numbers;
  TextScanner scanner(text);
  for (TextScanner ahead = scanner; !ahead.word().empty(); ahead = scanner) {
    const std::int64_t number = scanner.integer("a vertex number");
    if (number < least || number > std::numeric_limits<std::int32_t>::max()) scanner.fail(rule);
    numbers.push_back(static_cast<std::int32_t>(number));
  }
  return numbers;
}

}  // namespace

std::vector<std::int32_t> read_landmarks(std::string_view text) {
  std::vector<std::int32_t> landmarks = read_numbers(text, 1, "vertex numbers count from 1");
  for (std::int32_t& vertex : landmarks) --vertex;
  return landmarks;
}

std::vector<std::int32_t> read_indices(std::string_view text) {
  return read_numbers(text, -1, "vertex numbers count from 0, and -1 stands for none");
}

std::vector<std::int32_t> read_list_from_one(std::string_view text) {
  std::vector<std::int32_t> numbers = read_numbers(text, 0, "vertex numbers count from 1, and 0 stands for none");
  for (std::int32_t& number : numbers) --number;
  return numbers;
}

}  // namespace spherematch
