#include "cli/progress_bar.h"

#include <algorithm>

namespace spherematch {

namespace {

constexpr int width = 40;
constexpr std::chrono::milliseconds redraw_interval{50};
constexpr std::string_view wipe_line = "\r\x1b[K";

}  // namespace

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::report(std::string_view stage, double fraction) {
  if (!enabled_) return;
  const std::lock_guard lock(mutex_);
  if (fraction > fraction_) fraction_ = std::min(fraction, 1.0);
  const auto now = Clock::now();
  if (visible_ && stage == stage_ && now - drawn_ < redraw_interval) return;
  stage_ = stage;
  drawn_ = now;
  visible_ = true;
  const int filled = static_cast<int>(fraction_ * width);
  out_ << wipe_line << '[' << std::string(static_cast<std::size_t>(filled), '#')
       << std::string(static_cast<std::size_t>(width - filled), ' ') << "] " << static_cast<int>(fraction_ * 100) << "% " << stage_
       << std::flush;
}

void ProgressBar::clear() {
  const std::lock_guard lock(mutex_);
  if (visible_) out_ << wipe_line << std::flush;
  visible_ = false;
}

}  // namespace spherematch
