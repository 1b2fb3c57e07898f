// The formats in which `match -o` writes a map, told by the file's extension.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/data/correspondence.h"

namespace spherematch {

enum class OutputFormat { npz, npy, text };

/// Nothing where the extension is of no format. Case does not matter.
[[nodiscard]] std::optional<OutputFormat> output_format_of(const std::filesystem::path& file);

/// ".npz, .npy, .txt"
[[nodiscard]] std::string supported_extensions();

[[nodiscard]] std::string encode(const Correspondence& map, OutputFormat format);

}  // namespace spherematch
