#include "server/process_figures.h"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "server/descriptor.h"

namespace spherematch {
namespace {

TEST(ProcessFigures, AreThoseOfThisProcess) {
  const ProcessFigures before = process_figures();
  const double now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  EXPECT_LE(before.started, now + 2);  // the start is known to a second
  EXPECT_GT(before.started, now - 3600);
  EXPECT_GE(before.open_files, 3);
  EXPECT_GE(before.max_files, before.open_files);

  const Descriptor one(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  const Descriptor two(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  const std::vector<char> memory(std::size_t{64} << 20, 'x');
  volatile double sum = 0;
  while (process_figures().cpu_seconds < before.cpu_seconds + 0.05) {
    for (const char c : memory) sum = sum + c;
  }
  const ProcessFigures after = process_figures();
  EXPECT_EQ(after.open_files, before.open_files + 2);
  EXPECT_GT(after.resident_bytes, before.resident_bytes + (60 << 20));
  EXPECT_EQ(after.started, before.started);
}

}  // namespace
}  // namespace spherematch
