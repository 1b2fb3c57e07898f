// The configuration file: lines `flag = value` as in TOML, without sections, read by CLI11.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace spherematch {

/// "SPHEREMATCH_MAX_BODY_MIB" for "max-body-mib".
[[nodiscard]] std::string variable_of(const std::string& flag);

/// Adds --config FILE and SPHEREMATCH_CONFIG. A flag of the application stands before its environment variable, and that before the
/// file. A file that is missing, an unknown or repeated key, a section, and a value that is not one value end the parsing with an error.
void add_config_file(CLI::App& app);

}  // namespace spherematch
