// How the command ends; --help lists the same.
#pragma once

#include <stdexcept>

namespace spherematch {

enum ExitCode : int {
  exit_success = 0,
  exit_failure = 1,  ///< anything unforeseen
  exit_usage = 2,    ///< a wrong flag or argument
  exit_mesh = 3,     ///< a mesh that cannot be used
  exit_file = 4,     ///< a file or the store that cannot be read or written
};

/// A file that cannot be read or written; what() names it.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace spherematch
