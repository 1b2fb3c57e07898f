// SPDX-License-Identifier: MIT
#include "client/arrays.h"

#include <bit>
#include <cstring>
#include <map>
#include <stdexcept>
#include <utility>

#include "client/errors.h"

namespace spherematch::client {

namespace {

static_assert(std::endian::native == std::endian::little, "the arrays travel as they lie in memory");

[[noreturn]] void fail(const std::string& what) { throw FormatError("the server's answer is not an array file: " + what); }

template <typename Number>
Number number_at(std::string_view bytes, std::size_t offset) {
  if (bytes.size() < sizeof(Number) || offset > bytes.size() - sizeof(Number)) fail("it ends early");
  Number value{};
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::string_view part(std::string_view bytes, std::size_t offset, std::size_t size) {
  if (offset > bytes.size() || size > bytes.size() - offset) fail("it ends early");
  return bytes.substr(offset, size);
}

/// The files of a zip archive whose entries are stored as they are (APPNOTE 4.3: local header, central directory, its end).
std::map<std::string, std::string_view> stored_files(std::string_view zip) {
  constexpr std::string_view end_of_directory("PK\5\6", 4), entry("PK\1\2", 4);
  const auto end = zip.rfind(end_of_directory);
  if (end == std::string_view::npos) fail("no zip archive");
  (void)part(zip, end, 22);
  std::size_t at = number_at<std::uint32_t>(zip, end + 16);
  std::map<std::string, std::string_view> files;
  for (int left = number_at<std::uint16_t>(zip, end + 10); left > 0; --left) {
    if (part(zip, at, 4) != entry) fail("a broken directory");
    if (number_at<std::uint16_t>(zip, at + 10) != 0) fail("a compressed entry");
    const std::size_t size = number_at<std::uint32_t>(zip, at + 24), name_size = number_at<std::uint16_t>(zip, at + 28);
    const std::size_t header = number_at<std::uint32_t>(zip, at + 42);
    const std::size_t content = header + 30 + number_at<std::uint16_t>(zip, header + 26) + number_at<std::uint16_t>(zip, header + 28);
    files.emplace(part(zip, at + 46, name_size), part(zip, content, size));
    at += 46 + name_size + number_at<std::uint16_t>(zip, at + 30) + number_at<std::uint16_t>(zip, at + 32);
  }
  return files;
}

/// What follows the header of an NPY file (version 1.0) of the given type.
std::string_view numbers_of(std::string_view npy, std::string_view type) {
  if (!npy.starts_with("\x93NUMPY\x01")) fail("no NPY array");
  const std::size_t size = number_at<std::uint16_t>(npy, 8);
  const std::string_view header = part(npy, 10, size);
  if (header.find(std::string(1, '\'').append(type).append(1, '\'')) == std::string_view::npos)
    fail("an array of another type than " + std::string(type));
  if (header.find("'fortran_order': False") == std::string_view::npos) fail("an array in another order");
  return npy.substr(10 + size);
}

template <typename Row>
std::vector<Row> rows_of(const std::map<std::string, std::string_view>& files, const std::string& name, std::string_view type) {
  const auto file = files.find(name + ".npy");
  if (file == files.end()) fail("without " + name);
  const std::string_view bytes = numbers_of(file->second, type);
  if (bytes.size() % sizeof(Row) != 0) fail(name + " has broken rows");
  std::vector<Row> rows(bytes.size() / sizeof(Row));
  if (!rows.empty()) std::memcpy(rows.data(), bytes.data(), bytes.size());
  return rows;
}

Map map_of(const std::map<std::string, std::string_view>& files, const std::string& prefix) {
  const auto numbers_if_there = [&](const char* name) {
    return files.contains(prefix + name + ".npy") ? rows_of<float>(files, prefix + name, "<f4") : std::vector<float>();
  };
  Map map{.vertex = rows_of<std::int32_t>(files, prefix + "vertex", "<i4"),
          .corners = rows_of<std::array<std::int32_t, 3>>(files, prefix + "corners", "<i4"),
          .bary = rows_of<std::array<float, 3>>(files, prefix + "bary", "<f4"),
          .confidence = numbers_if_there("confidence"),
          .distortion = numbers_if_there("distortion"),
          .reverse = nullptr};
  const auto differs = [&map](const auto& rows) { return rows.size() != map.vertex.size(); };
  if (differs(map.corners) || differs(map.bary) || (!map.confidence.empty() && differs(map.confidence)) ||
      (!map.distortion.empty() && differs(map.distortion)))
    fail("arrays of different lengths");
  return map;
}

}  // namespace

Map decode_map(std::string_view npz) {
  const auto files = stored_files(npz);
  Map map = map_of(files, "");
  if (files.contains("reverse_vertex.npy")) map.reverse = std::make_shared<const Map>(map_of(files, "reverse_"));
  return map;
}

std::string encode_npy(std::span<const double> values, std::size_t columns) {
  if (columns == 0 || values.size() % columns != 0) throw std::invalid_argument("the values are no whole rows");
  std::string shape = std::to_string(values.size() / columns) + ",";
  if (columns > 1) shape.append(1, ' ').append(std::to_string(columns));
  std::string header = std::string("{'descr': '<f8', 'fortran_order': False, 'shape': (").append(shape).append("), }");
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  std::string npy("\x93NUMPY\x01\0", 8);
  const auto size = static_cast<std::uint16_t>(header.size());
  npy.append(reinterpret_cast<const char*>(&size), sizeof size).append(header);
  if (!values.empty()) npy.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  return npy;
}

std::vector<double> decode_npy(std::string_view npy) {
  const std::string_view bytes = numbers_of(npy, "<f8");
  if (bytes.size() % sizeof(double) != 0) fail("broken numbers");
  std::vector<double> values(bytes.size() / sizeof(double));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

}  // namespace spherematch::client
