// API keys at rest: a text file with one key a line, of which only the SHA-256 is written down.
//
//   # name scope sha256-of-the-key made
//   ci write 9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08 2024-01-31
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace spherematch {

/// Each allows what those before it allow.
enum class Scope { read, write, admin };

[[nodiscard]] std::string_view to_string(Scope scope);
[[nodiscard]] std::optional<Scope> scope_of(std::string_view text);

struct Key {
  std::string name;  ///< 1 to 64 of A-Z a-z 0-9 . _ -, once in a file
  Scope scope = Scope::read;
  std::string sha256;  ///< 64 lower-case hex digits, of the key's text
  std::string made;    ///< a date, for people
  bool operator==(const Key&) const = default;
};

/// what() names the file or the line.
class KeyFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Empty lines and lines that begin with # are passed over. @throws KeyFileError
[[nodiscard]] std::vector<Key> parse_keys(std::string_view text);

/// @throws KeyFileError
[[nodiscard]] std::vector<Key> read_key_file(const std::filesystem::path& file);

/// Adds a key of that name, making the file where it is missing, and returns the key's text, which is written down nowhere. The file is
/// replaced in one step, readable by its owner alone; its comments stay. Safe beside other processes that do the same.
/// @throws KeyFileError also where the name is taken or unfit
[[nodiscard]] std::string add_key(const std::filesystem::path& file, const std::string& name, Scope scope);

/// @throws KeyFileError also where there is no such key
void remove_key(const std::filesystem::path& file, const std::string& name);

/// 64 lower-case hex digits.
[[nodiscard]] std::string sha256_of(std::string_view text);

/// Takes the same time wherever two texts of one length differ.
[[nodiscard]] bool equal_in_constant_time(std::string_view a, std::string_view b);

}  // namespace spherematch
