#include "server/priority.h"

#include <sys/resource.h>

#include <algorithm>
#include <cerrno>

namespace spherematch {

void be_nice(int niceness) {
  // On Linux "process 0" is the calling thread. A program that was started nicer than that stays so.
  errno = 0;
  const int now = ::getpriority(PRIO_PROCESS, 0);
  if (errno == 0) ::setpriority(PRIO_PROCESS, 0, std::max(now, niceness));
}

}  // namespace spherematch
