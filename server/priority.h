// Whoever computes for long leaves the processors to those who answer at once.
#pragma once

namespace spherematch {

/// Nice values. Requests as such keep the program's own; a match goes before preparations, since somebody waits for it.
inline constexpr int match_niceness = 5;
inline constexpr int preparation_niceness = 10;

/// Of the calling thread and of those that it will start; never taken back, which takes privileges. A system that refuses is let be.
void be_nice(int niceness);

}  // namespace spherematch
