#include "cli/output_format.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace spherematch {

std::optional<MapFormat> output_format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension.starts_with('.') ? map_format_of(std::string_view(extension).substr(1)) : std::nullopt;
}

std::string supported_extensions() {
  std::string text;
  for (const std::string_view name : map_format_names()) text.append(text.empty() ? "." : ", .").append(name);
  return text;
}

}  // namespace spherematch
