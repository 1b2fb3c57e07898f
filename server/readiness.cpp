#include "server/readiness.h"

#include <fmt/format.h>

namespace spherematch {

std::vector<api::ReadinessCheck> Readiness::report() const {
  std::vector<api::ReadinessCheck> lines;
  for (const Named& named : checks_) {
    BackgroundCheck::Answer answer = named.check();
    lines.push_back({named.name, answer.good, std::move(answer.detail)});
  }
  return lines;
}

BackgroundCheck::Answer check_free_space(const std::filesystem::path& file, std::uintmax_t least) {
  std::error_code error;
  const std::filesystem::path directory = file.has_parent_path() ? file.parent_path() : ".";
  const std::filesystem::space_info space = std::filesystem::space(directory, error);
  if (error) return {.good = false, .detail = "the free space is not known: " + error.message()};
  constexpr std::uintmax_t mib = 1 << 20;
  const std::string found = fmt::format("{} MiB are free", space.available / mib);
  if (space.available < least) return {.good = false, .detail = fmt::format("{}, fewer than {}", found, least / mib)};
  return {.good = true, .detail = found};
}

BackgroundCheck::Answer check_progress(const std::string& what, std::chrono::steady_clock::duration longest, std::chrono::seconds limit) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(longest);
  if (longest <= limit) return {.good = true, .detail = what + " move on"};
  return {.good = false, .detail = fmt::format("nothing heard of the {} for {} s", what, seconds.count())};
}

}  // namespace spherematch
