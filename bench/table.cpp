#include "bench/table.h"

#include <array>
#include <cstdio>

namespace spherematch::bench {

namespace {

std::string line(std::int32_t vertices, const std::string& what, double seconds, const std::string& share) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "%9d  %-28s %9.4f %7s\n", vertices, what.c_str(), seconds, share.c_str());
  return text.data();
}

std::string percent(double part, double whole) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.1f %%", whole > 0 ? 100 * part / whole : 0);
  return text.data();
}

std::string rows_of(const std::string& what, const Timing& timing, std::int32_t vertices) {
  const double total = total_of(timing.seconds);
  std::string rows;
  for (const auto& [stage, seconds] : timing.seconds) rows += line(vertices, what + ": " + stage, seconds, percent(seconds, total));
  return rows + line(vertices, what + ": processor time", timing.cpu_seconds, percent(timing.cpu_seconds, total));
}

std::string foot_of(const std::string& what, int runs, double mebibytes) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "%s: median of %d, at most %.0f MiB\n", what.c_str(), runs, mebibytes);
  return text.data();
}

}  // namespace

std::string table_of(const PairResult& result) {
  return result.source + " and " + result.target + "\n vertices  stage                          seconds   share\n" +
         line(result.vertices, "reading", result.read_seconds, "") + rows_of("preparation", result.preparation, result.vertices) +
         rows_of("match", result.match, result.vertices) + foot_of("preparation", result.preparation.runs, result.preparation_mebibytes) +
         foot_of("match", result.match.runs, result.match_mebibytes);
}

}  // namespace spherematch::bench
