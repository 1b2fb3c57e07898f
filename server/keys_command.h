// `spherematch-server keys add|list|remove`: changes a file of keys.
#pragma once

#include <string>

namespace spherematch {

/// The first argument by which main() knows the command.
inline constexpr const char* keys_argument = "keys";

/// `argv` begins with that argument. Prints to standard output and error; returns the exit code: 0, 1 for what went wrong, 2 for bad
/// arguments.
[[nodiscard]] int keys_command(int argc, const char* const* argv);

}  // namespace spherematch
