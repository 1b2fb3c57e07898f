// Whether the server can do its work now: what /readyz says.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "api/types.h"
#include "server/background_check.h"

namespace spherematch {

class ShapeService;
class ShapeStore;
class Gate;

/// Thread-safe once every check is added.
class Readiness {
 public:
  /// One line of the report: good or not, and a sentence either way. Must not wait for long.
  using Check = std::function<BackgroundCheck::Answer()>;

  void add(std::string name, Check check) { checks_.push_back({std::move(name), std::move(check)}); }

  /// Every check, in the order in which they were added.
  [[nodiscard]] std::vector<api::ReadinessCheck> report() const;

 private:
  struct Named {
    std::string name;
    Check check;
  };
  std::vector<Named> checks_;
};

/// Whether `least` bytes are free on the disk of the file.
[[nodiscard]] BackgroundCheck::Answer check_free_space(const std::filesystem::path& file, std::uintmax_t least);

/// Whether work moves on: `longest` is for how long the one that has been silent longest has been so.
[[nodiscard]] BackgroundCheck::Answer check_progress(const std::string& what, std::chrono::steady_clock::duration longest,
                                                     std::chrono::seconds limit);

}  // namespace spherematch
