#include "engine/io/mesh_reader.h"

#include <algorithm>
#include <array>

#include "engine/data/error.h"
#include "engine/io/off.h"

namespace spherematch {

namespace {

/// One row per format; a format is tried by content in this order, then by the extension of the name.
struct Format {
  std::string_view extension;
  bool (*recognises)(std::string_view text);
  PolygonMesh (*read)(std::string_view text, const ReadLimits& limits);
};

constexpr std::array formats{Format{".off", is_off, read_off}};

bool ends_with_ignoring_case(std::string_view name, std::string_view extension) {
  if (name.size() < extension.size()) return false;
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(extension.begin(), extension.end(), name.end() - static_cast<std::ptrdiff_t>(extension.size()),
                    [&](char e, char n) { return e == lower(n); });
}

}  // namespace

PolygonMesh read_mesh(std::span<const std::byte> bytes, std::string_view name, const ReadLimits& limits) {
  if (bytes.empty()) throw EngineError(ErrorCode::malformed_mesh, "the mesh file is empty");
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const Format& format : formats)
    if (format.recognises(text)) return format.read(text, limits);
  for (const Format& format : formats)
    if (ends_with_ignoring_case(name, format.extension)) return format.read(text, limits);
  throw EngineError(ErrorCode::unsupported_format, "the format of the mesh file is not recognised; OFF is supported");
}

}  // namespace spherematch
