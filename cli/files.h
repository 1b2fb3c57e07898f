// Whole files in and out, with errors that name them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace spherematch {

/// @throws FileError
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& file);

/// Makes the file or replaces its content. @throws FileError
void write_file(const std::filesystem::path& file, const std::string& bytes);

}  // namespace spherematch
