// The formats in which `match -o` writes a map, told by the file's extension.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/io/map_format.h"

namespace spherematch {

/// Nothing where the extension is of no format. Case does not matter.
[[nodiscard]] std::optional<MapFormat> output_format_of(const std::filesystem::path& file);

/// ".npz, .npy, .txt, ..."
[[nodiscard]] std::string supported_extensions();

}  // namespace spherematch
