// What this process takes of the machine (Linux), and work done in a process of its own.
#pragma once

#include <functional>
#include <string>

namespace spherematch::bench {

/// Time on processors of all threads since the start.
[[nodiscard]] double cpu_seconds();

/// Returns freed memory to the system and starts the peak of peak_mebibytes() afresh.
void reset_peak_memory();
/// The most resident memory since reset_peak_memory() or the start.
[[nodiscard]] double peak_mebibytes();

/// What `work` returns, run in a child process, so that neither memory nor caches of one measurement are there in the next. Only while
/// this process has no other threads. @throws std::runtime_error with the child's message, or with how it ended
[[nodiscard]] std::string in_child(const std::function<std::string()>& work);

}  // namespace spherematch::bench
