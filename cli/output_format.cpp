#include "cli/output_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "engine/io/map_writer.h"

namespace spherematch {

namespace {

constexpr std::array<std::pair<std::string_view, OutputFormat>, 3> extensions{{
    {".npz", OutputFormat::npz},
    {".npy", OutputFormat::npy},
    {".txt", OutputFormat::text},
}};

}  // namespace

std::optional<OutputFormat> output_format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [name, format] : extensions) {
    if (name == extension) return format;
  }
  return std::nullopt;
}

std::string supported_extensions() {
  std::string text;
  for (const auto& [name, format] : extensions) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

std::string encode(const Correspondence& map, OutputFormat format) {
  switch (format) {
    case OutputFormat::npz:
      return encode_npz(map);
    case OutputFormat::npy:
      return encode_npy(map);
    case OutputFormat::text:
      return encode_text(map);
  }
  return {};
}

}  // namespace spherematch
