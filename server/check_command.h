// `spherematch-server --check`: asks a running server whether it is ready, for the health check of a container.
#pragma once

#include <string>

namespace spherematch {

/// Asks the server that these options would start on this machine for /readyz, and prints the answer. 0 when it is ready, else 1.
[[nodiscard]] int check_command(const std::string& host, int port);

}  // namespace spherematch
