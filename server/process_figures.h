// What the system says of this process.
#pragma once

namespace spherematch {

/// A figure that the system does not give is 0.
struct ProcessFigures {
  double cpu_seconds = 0;
  double resident_bytes = 0;
  double open_files = 0;
  double max_files = 0;
  double started = 0;  ///< seconds since 1970
};

/// Thread-safe.
[[nodiscard]] ProcessFigures process_figures();

}  // namespace spherematch
